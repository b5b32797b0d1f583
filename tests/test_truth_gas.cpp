// The elastic gas in equilibrium: event-driven runs against published constants and kinetic theory.
#include <numbers>

#include "tests/truth_support.h"
#include "truth/chaos.h"
#include "truth/event_driven.h"
#include "truth/gas.h"
#include "truth/kinetic_theory.h"
#include "truth/statistics.h"

using namespace ballpit::truth;

namespace {

/// After `collisions`, with the counts begun anew: a gas that has forgotten its lattice.
EventDriven equilibrated(const Gas& gas, std::uint64_t collisions) {
    EventDriven simulator(gas.balls, {.box = gas.box, .periodic = true});
    simulator.runUntil(1e9, collisions);
    simulator.resetCounts();
    return simulator;
}

/// Collisions a ball has until two runs that start `difference` apart differ by a 100th of a
/// diameter, root mean square.
double collisionsUntilUnlike(double density, double difference) {
    const Gas gas = latticeGas({.cellsPerSide = 5, .density = density});
    const double side = gas.box.upper.x;
    const Balls start = equilibrated(gas, 20000).balls();
    Balls moved = start;
    for (Ball& ball : moved)  // towards the middle, so that none leaves the box
        ball.position.x += ball.position.x < side / 2 ? difference : -difference;
    EventDriven one(start, {.box = gas.box, .periodic = true});
    EventDriven other(moved, {.box = gas.box, .periodic = true});
    const auto count = static_cast<double>(start.size());
    for (double apart = 0; apart < 0.01;) {
        one.runUntil(one.time() + 0.05);
        other.runUntil(one.time());
        const Balls p = one.balls(), q = other.balls();
        double sum = 0;
        for (std::size_t k = 0; k < p.size(); ++k)
            for (int axis = 0; axis < 3; ++axis) {
                const double x = q[k].position[axis] - p[k].position[axis];
                sum += std::pow(x - side * std::round(x / side), 2);
            }
        apart = std::sqrt(sum / count);
    }
    return 2 * static_cast<double>(one.counts().collisions) / count;
}

}  // namespace

TEST_CASE("truth: the mean free time of 1372 balls at half density is the published 0.13031",
          "[long]") {
    const Gas gas = latticeGas({.cellsPerSide = 7, .density = 0.5});
    REQUIRE(gas.balls.size() == 1372);
    EventDriven simulator = equilibrated(gas, 50000);
    simulator.runUntil(1e9, 100000);
    CHECK(simulator.meanFreeTime() == withinShare(0.13031, 0.02));
    CHECK(simulator.invalidStates() == 0);
    CHECK(kineticEnergy(simulator.balls()) == withinShare(kineticEnergy(gas.balls), 1e-12));
    CHECK(length(momentum(simulator.balls())) < 1e-11);
}

TEST_CASE("truth: pressure and collision rate are Carnahan and Starling's and Enskog's", "[long]") {
    for (const double density : {0.2, 0.5}) {
        CAPTURE(density);
        const Gas gas = latticeGas({.cellsPerSide = 5, .density = density});
        EventDriven simulator = equilibrated(gas, 30000);
        simulator.runUntil(1e9, 100000);
        const double eta = volumeShare(density, 1);
        CHECK(simulator.compressibility() == withinShare(carnahanStarling(eta), 0.01));
        CHECK(simulator.meanFreeTime() == withinShare(enskogMeanFreeTime(density, 1, 1, 1), 0.02));
    }
}

TEST_CASE("truth: pressure and rate scale with size, mass and temperature as they must") {
    const Gas gas = latticeGas(
        {.cellsPerSide = 5, .density = 0.5, .radius = 0.05, .mass = 3, .temperature = 0.02});
    EventDriven simulator = equilibrated(gas, 30000);
    simulator.runUntil(1e9, 50000);
    const double sigma = 0.1, rho = 0.5 / (sigma * sigma * sigma);
    CHECK(temperature(simulator.balls()) == withinShare(0.02, 1e-12));
    CHECK(simulator.meanFreeTime() == withinShare(enskogMeanFreeTime(rho, sigma, 0.02, 3), 0.02));
    CHECK(simulator.compressibility() ==
          withinShare(carnahanStarling(volumeShare(rho, sigma)), 0.015));
}

TEST_CASE("truth: the forms of kinetic theory fit together") {
    for (const double eta : {0.01, 0.1047, 0.2618, 0.4}) {
        CHECK(carnahanStarling(eta) == withinShare(1 + 4 * eta * contactValue(eta), 1e-14));
        const double rho = eta * 6 / std::numbers::pi;
        CHECK(enskogMeanFreeTime(rho, 1, 1, 1) * enskogRate(rho, 1, 1, 1) == within(1, 1e-15));
    }
    CHECK(volumeShare(0.5, 1) == within(0.261799, 1e-6));
    CHECK(carnahanStarling(0.2618) == within(3.2624, 1e-3));
    CHECK(haffCooling(3, 3) == 0.25);
    CHECK(speedShareBelow(0, 2, 3) == 0);
    CHECK(speedShareBelow(100, 2, 3) == within(1, 1e-15));
    CHECK(componentShareBelow(0, 2, 3) == 0.5);
    double mean = 0;  // of a distribution above 0: the integral of the share beyond v
    for (int k = 0; k < 10000; ++k) mean += 1e-3 * (1 - speedShareBelow(1e-3 * (k + 0.5), 2, 3));
    CHECK(mean == withinShare(meanSpeed(2, 3), 1e-6));
}

TEST_CASE("truth: balls that all start equally fast end with Maxwell's and Boltzmann's speeds",
          "[long]") {
    Gas gas = latticeGas({.cellsPerSide = 7, .density = 0.3});
    for (Ball& ball : gas.balls)  // every component 1 or -1: T = 1
        for (int axis = 0; axis < 3; ++axis) ball.velocity[axis] = ball.velocity[axis] < 0 ? -1 : 1;
    EventDriven simulator(gas.balls, {.box = gas.box, .periodic = true});
    std::vector<double> components, speeds;
    const auto sample = [&] {
        for (const Ball& ball : simulator.balls()) {
            for (int axis = 0; axis < 3; ++axis) components.push_back(ball.velocity[axis]);
            speeds.push_back(length(ball.velocity));
        }
    };
    const auto chance = [](const std::vector<double>& values, auto shareBelow) {
        return kolmogorovProbability(kolmogorovDistance(values, shareBelow), values.size());
    };
    const auto component = [](double v) { return componentShareBelow(v, 1, 1); };
    const auto speed = [](double v) { return speedShareBelow(v, 1, 1); };

    sample();
    CHECK(chance(components, component) < 1e-9);
    CHECK(chance(speeds, speed) < 1e-9);

    components.clear();
    speeds.clear();
    simulator.runUntil(1e9, 15000);
    for (int k = 0; k < 8; ++k) {
        simulator.runUntil(1e9, 10000);
        sample();
    }
    CHECK(chance(components, component) > 0.001);
    CHECK(chance(speeds, speed) > 0.001);
    CHECK(moment(speeds, 1) == withinShare(meanSpeed(1, 1), 0.01));
    CHECK(moment(speeds, 4) / std::pow(moment(speeds, 2), 2) ==
          withinShare(fourthMomentRatio, 0.02));
}

TEST_CASE(
    "truth: runs that differ by a trillionth differ visibly after 14 or 29 collisions a ball") {
    for (const double difference : {1e-12, 1e-7}) {
        CAPTURE(difference);
        CHECK(collisionsUntilUnlike(0.2, difference) ==
              withinShare(comparableCollisions(difference, 0.01, growthDilute), 0.3));
        CHECK(collisionsUntilUnlike(0.5, difference) ==
              withinShare(comparableCollisions(difference, 0.01, growthDense), 0.3));
    }
    CHECK(comparableCollisions(1e-12, 0.01, growthDilute) == within(13.5, 0.1));
}

TEST_CASE("truth: the test of Kolmogorov and Smirnov has its tabulated points") {
    CHECK(kolmogorovProbability(1.358 / std::sqrt(1e6), 1000000) == within(0.05, 5e-4));
    CHECK(kolmogorovProbability(1.628 / std::sqrt(1e6), 1000000) == within(0.01, 5e-4));
    std::vector<double> even;
    for (int k = 0; k < 100; ++k) even.push_back((k + 0.5) / 100);
    CHECK(kolmogorovDistance(even, [](double v) { return v; }) == within(0.005, 1e-12));
}

TEST_CASE("truth: a starting gas has its temperature, no momentum, and nothing overlaps") {
    for (const bool walled : {false, true}) {
        const Gas gas = latticeGas({.cellsPerSide = 3, .density = 0.8, .temperature = 2.5}, walled);
        CHECK(gas.balls.size() == 108);
        CHECK(temperature(gas.balls) == withinShare(2.5, 1e-13));
        CHECK(length(momentum(gas.balls)) < 1e-12);
        CHECK(deepestOverlap(gas.balls) == 0);
        const double side = gas.box.upper.x;
        CHECK(108 / (side * side * side) == withinShare(0.8, 1e-12));
        for (const Ball& ball : gas.balls)
            for (int axis = 0; axis < 3; ++axis) {
                CHECK(ball.position[axis] >= (walled ? 0.5 : 0.0));
                CHECK(ball.position[axis] <= side - (walled ? 0.5 : 0.0));
            }
    }
}
