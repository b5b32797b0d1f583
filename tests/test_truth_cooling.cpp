// Inelastic balls: Haff's cooling law, and the collapse in which collisions pile up without end.
#include "tests/truth_support.h"
#include "truth/event_driven.h"
#include "truth/gas.h"
#include "truth/kinetic_theory.h"
#include "truth/motion.h"

using namespace ballpit::truth;

namespace {

/// Below it three balls on a line collapse (McNamara and Young 1992): 7 - 4 sqrt(3).
const double threeBallLimit = 7 - 4 * std::sqrt(3.0);

/// Two balls run from both sides into a third.
Balls threeOnALine(double e) {
    return {{{-2, 0, 0}, {1, 0, 0}, 0.5, 1, e},
            {{0, 0, 0}, {}, 0.5, 1, e},
            {{2.3, 0, 0}, {-1, 0, 0}, 0.5, 1, e}};
}

bool allPart(const Balls& balls) {
    return balls[0].velocity.x < balls[1].velocity.x && balls[1].velocity.x < balls[2].velocity.x;
}

/// T(t) / (T0 Haff(t)) at the times t = 1, 2, 4 Haff times, averaged over three gases of 1372
/// balls.
std::vector<double> coolingAgainstHaff(double e) {
    const double density = 0.2;
    std::vector<double> ratios(3, 0.0);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const Gas gas = latticeGas({.cellsPerSide = 7, .density = density, .seed = seed});
        EventDriven elastic(gas.balls, {.box = gas.box, .periodic = true});
        elastic.runUntil(1e9, 20000);
        Balls balls = elastic.balls();
        for (Ball& ball : balls) ball.restitution = e;
        EventDriven cooling(balls, {.box = gas.box, .periodic = true});
        const double unit = haffTime(e, enskogRate(density, 1, 1, 1));
        for (std::size_t k = 0; k < ratios.size(); ++k) {
            const double time = unit * static_cast<double>(1 << k);
            cooling.runUntil(time);
            ratios[k] += temperature(cooling.balls()) / haffCooling(time, unit) / 3;
        }
        CHECK(cooling.invalidStates() == 0);
    }
    return ratios;
}

}  // namespace

TEST_CASE("truth: an inelastic gas cools by Haff's law, to four Haff times", "[long]") {
    struct Case {
        double e, tolerance;
    };
    for (const auto& [e, tolerance] : {Case{0.95, 0.025}, Case{0.9, 0.08}, Case{0.8, 0.16}}) {
        CAPTURE(e);
        for (const double ratio : coolingAgainstHaff(e)) CHECK(ratio == within(1, tolerance));
    }
}

TEST_CASE("truth: three balls on a line collapse below e = 7 - 4 sqrt 3 and not above") {
    for (const double e : {0.03, 0.06, 0.99 * threeBallLimit}) {
        CAPTURE(e);
        EventDriven simulator(threeOnALine(e), {.box = farWalls()});
        simulator.runUntil(1000, 400);
        CHECK(simulator.counts().collisions == 400);
        CHECK(simulator.time() < 2);  // all of them in a moment
    }
    for (const double e : {1.02 * threeBallLimit, 0.08, 0.2, 0.5}) {
        CAPTURE(e);
        EventDriven simulator(threeOnALine(e), {.box = farWalls()});
        simulator.runUntil(1000, 400);
        CHECK(simulator.counts().collisions < 60);
        CHECK(simulator.time() == 1000);
        CHECK(allPart(simulator.balls()));
    }
}

TEST_CASE("truth: collisions without duration collapse, the TC model ends it") {
    for (const double e : {0.03, 0.06}) {
        CAPTURE(e);
        EventDriven simulator(threeOnALine(e), {.box = farWalls(), .contactTime = 1e-6});
        simulator.runUntil(1000, 400);
        CHECK(simulator.counts().collisions < 60);
        CHECK(simulator.counts().elasticByContactTime > 0);
        CHECK(allPart(simulator.balls()));
    }
}

TEST_CASE("truth: a ball that comes to rest on the floor stops the clock, unless by the TC model") {
    const double h0 = 1, r = 0.1, g = 9.81, e = 0.5;
    EventSettings settings{.box = {{-9, 0, -9}, {9, 9, 9}}, .gravity = {0, -g, 0}};
    const Balls balls{{{0, h0, 0}, {}, r, 1, e}};
    const double rest = bouncingTime(h0, r, g, e);

    EventDriven without(balls, settings);
    without.runUntil(2 * rest, 1000);
    CHECK(without.counts().wallCollisions == 1000);
    CHECK(without.time() == within(rest, 1e-9));

    settings.contactTime = 1e-3;
    EventDriven with(balls, settings);
    with.runUntil(2 * rest, 100000);
    CHECK(with.time() == 2 * rest);
    CHECK(with.balls()[0].position.y == within(r, 1e-5));
    CHECK(with.invalidStates() == 0);
}

TEST_CASE("truth: the TC model leaves a gas alone whose collisions lie apart") {
    const Gas gas = latticeGas({.cellsPerSide = 4, .density = 0.1, .restitution = 0.9});
    const auto cooled = [&](double contactTime) {
        EventDriven simulator(gas.balls,
                              {.box = gas.box, .periodic = true, .contactTime = contactTime});
        simulator.runUntil(100);
        return temperature(simulator.balls());
    };
    const double without = cooled(0);
    CHECK(cooled(1e-7) == withinShare(without, 0.01));
    CHECK(without < 0.5);
    CHECK(cooled(1e3) > 0.9);  // so long that nearly all are elastic
}
