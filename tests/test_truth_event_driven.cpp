// The event-driven simulator itself: moments of contact, images, walls, crowds of all sizes, and
// what it refuses.
#include <stdexcept>

#include "tests/truth_support.h"
#include "truth/event_driven.h"
#include "truth/event_times.h"
#include "truth/gas.h"

using namespace ballpit::truth;

namespace {

/// A gas of two kinds of balls with different radii, masses and restitutions.
Gas mixture(double density, bool walled) {
    Gas gas = latticeGas({.cellsPerSide = 4, .density = density, .seed = 4}, walled);
    for (std::size_t k = 0; k < gas.balls.size(); k += 3) {
        gas.balls[k].radius = 0.3;
        gas.balls[k].mass = 0.2;
    }
    return gas;
}

}  // namespace

TEST_CASE("truth: two balls touch when their surfaces meet, and never if they pass or part") {
    CHECK(timeToTouch({3, 0, 0}, {-2, 0, 0}, 1) == withinShare(1, 1e-15));
    CHECK(timeToTouch({3, 0.6, 0}, {-2, 0, 0}, 1) == withinShare((3 - 0.8) / 2, 1e-15));
    CHECK(timeToTouch({3, 1.1, 0}, {-2, 0, 0}, 1) == never);
    CHECK(timeToTouch({3, 0, 0}, {2, 0, 0}, 1) == never);
    CHECK(timeToTouch({3, 0, 0}, {0, 0, 0}, 1) == never);
}

TEST_CASE("truth: balls that overlap a little collide at once if they approach, else never") {
    CHECK(timeToTouch({1 - 1e-12, 0, 0}, {-2, 0, 0}, 1) == 0);
    CHECK(timeToTouch({1 - 1e-12, 0, 0}, {2, 0, 0}, 1) == never);
}

TEST_CASE("truth: a near contact keeps its digits where the schoolbook root loses them") {
    const double gap = 0x1p-44, v = 1e4 / 3;  // 1 + gap is exact
    const double b = -v * (1 + gap), c = 2 * gap;
    const double schoolbook = (-b - std::sqrt(b * b - v * v * c)) / (v * v);
    CHECK(timeToTouch({1 + gap, 0, 0}, {-v, 0, 0}, 1) == withinShare(gap / v, 1e-12));
    CHECK(std::abs(schoolbook * v / gap - 1) > 1e-6);
}

TEST_CASE("truth: a plane is reached by the root that moves outwards through it") {
    CHECK(timeToLeave(2, 1, 0) == withinShare(2, 1e-15));
    CHECK(timeToLeave(2, -1, 0) == never);
    CHECK(timeToLeave(5, 0, 10) == withinShare(1, 1e-15));
    CHECK(timeToLeave(0, -5, 10) == withinShare(1, 1e-15));      // thrown up from the floor
    CHECK(timeToLeave(-1e-15, -5, 10) == withinShare(1, 1e-9));  // from a hair below it
    CHECK(timeToLeave(2, 1, -10) == never);                      // turns before the ceiling
    CHECK(timeToLeave(0, 1, -10) == 0);
    CHECK(timeToLeave(0, -1, -10) == never);
    CHECK(timeToLeave(0, 0, 10) == 0);
}

TEST_CASE("truth: two balls meet through the sides of a periodic box") {
    const Balls balls{{{0.6, 2, 2}, {-1, 0, 0}}, {{7.4, 2, 2}, {1, 0, 0}}};
    EventDriven simulator(balls, {.box = {{0, 0, 0}, {8, 4, 4}}, .periodic = true});
    simulator.runUntil(1);
    CHECK(simulator.counts().collisions == 1);  // 1.2 m apart through the side: after 0.1 s
    CHECK(simulator.balls()[0].velocity.x == within(1, 1e-15));
    CHECK(simulator.balls()[0].position.x == within(0.5 + 0.9, 1e-14));
    simulator.runUntil(20);
    for (const Ball& ball : simulator.balls()) {
        CHECK(ball.position.x >= -1e-12);
        CHECK(ball.position.x <= 8 + 1e-12);
    }
}

TEST_CASE("truth: no collision is missed, dilute or dense, of two sizes, periodic or walled") {
    for (const double density : {0.05, 0.5, 0.9})
        for (const bool walled : {false, true}) {
            CAPTURE(density, walled);
            const Gas gas = mixture(density, walled);
            EventDriven simulator(gas.balls, {.box = gas.box, .periodic = !walled});
            for (int k = 0; k < 5; ++k) {
                simulator.runUntil(1e9, 3000);
                REQUIRE(simulator.invalidStates() == 0);
            }
            CHECK(simulator.counts().overlapping == 0);
            CHECK((simulator.counts().wallCollisions > 0) == walled);
            CHECK(kineticEnergy(simulator.balls()) == withinShare(kineticEnergy(gas.balls), 1e-12));
            if (!walled) CHECK(length(momentum(simulator.balls()) - momentum(gas.balls)) < 1e-11);
        }
}

TEST_CASE("truth: balls that fall together keep their energy, between walls and with collisions") {
    const Gas gas = mixture(0.2, true);
    const Vector gravity{0.5, -2, 0.1};
    EventDriven simulator(gas.balls, {.box = gas.box, .gravity = gravity});
    const auto energy = [&](const Balls& balls) {
        return kineticEnergy(balls) + potentialEnergy(balls, gravity);
    };
    simulator.runUntil(1e9, 20000);
    CHECK(simulator.counts().collisions > 5000);
    CHECK(energy(simulator.balls()) == withinShare(energy(gas.balls), 1e-11));
    CHECK(simulator.invalidStates() == 0);
}

TEST_CASE("truth: invalid states are seen: an overlap, a ball outside, a value not finite") {
    const auto invalid = [](Balls balls) {
        return EventDriven(std::move(balls), {.box = farWalls()}).invalidStates();
    };
    CHECK(invalid({{{0, 0, 0}, {}}, {{2, 0, 0}, {}}}) == 0);
    CHECK(invalid({{{0, 0, 0}, {}}, {{0.99, 0, 0}, {}}}) == 1);
    CHECK(invalid({{{0, 0, 0}, {0, std::nan(""), 0}}}) == 1);
}

TEST_CASE("truth: a run stops at its time or at its number of collisions, whichever comes first") {
    EventDriven simulator(cradle(5, 0.1), {.box = farWalls()});
    simulator.runUntil(0.25);
    CHECK(simulator.time() == 0.25);
    CHECK(simulator.counts().collisions == 2);
    simulator.runUntil(100, 1);
    CHECK(simulator.counts().collisions == 3);
    CHECK(simulator.time() == within(0.3, 1e-12));
}

TEST_CASE("truth: the event-driven simulator refuses what it cannot run") {
    const Balls one{{{1, 1, 1}, {}}};
    CHECK_THROWS_AS(EventDriven(one, {.box = {{0, 0, 0}, {3, 8, 8}}, .periodic = true}),
                    std::invalid_argument);
    CHECK_THROWS_AS(
        EventDriven(one, {.box = {{0, 0, 0}, {8, 8, 8}}, .periodic = true, .gravity = {0, -1, 0}}),
        std::invalid_argument);
    CHECK_THROWS_AS(EventDriven(one, {.box = {{0.7, 0, 0}, {8, 8, 8}}}), std::invalid_argument);
}
