// Closed forms of collisions against one another, and against both simulators of truth/.
#include <numbers>

#include "tests/truth_support.h"
#include "truth/accumulated.h"
#include "truth/collisions.h"
#include "truth/event_driven.h"

using namespace ballpit::truth;

namespace {

/// Two balls on the x axis, 1 m between their surfaces.
Balls onALine(double m1, double v1, double m2, double v2, double e) {
    return {{{0, 0, 0}, {v1, 0, 0}, 0.5, m1, e}, {{2, 0, 0}, {v2, 0, 0}, 0.5, m2, 1}};
}

/// A hub that moves with 1 m/s along z into `count` resting spokes around its way, at the cosine c
/// to it: the energy after a plain sum of all pair impulses, as a share of that before.
double energyAfterPlainSum(int count, double c, double hubMass, double spokeMass, double e) {
    Balls balls{{{}, {0, 0, 1}, 0.5, hubMass, e}};
    for (int k = 0; k < count; ++k) {
        const double turn = 2 * std::numbers::pi * k / count, s = std::sqrt(1 - c * c);
        balls.push_back({{s * std::cos(turn), s * std::sin(turn), c}, {}, 0.5, spokeMass, e});
    }
    const Balls before = balls;
    for (std::size_t k = 1; k < balls.size(); ++k) {
        Ball hub = before[0];
        collide(hub, balls[k], balls[k].position, e);
        balls[0].velocity += hub.velocity - before[0].velocity;
    }
    return kineticEnergy(balls) / kineticEnergy(before);
}

}  // namespace

TEST_CASE("truth: a head-on collision keeps momentum and loses energy by the formula") {
    for (const double m2 : {1.0, 3.0, 1000.0})
        for (const double e : {0.0, 0.5, 1.0}) {
            CAPTURE(m2, e);
            const LineSpeeds after = headOn(2, 3, m2, -1, e);
            CHECK(2 * after.first + m2 * after.second == withinShare(2 * 3 - m2, 1e-14));
            CHECK(after.second - after.first == within(e * 4, 1e-13));
            const double before = 0.5 * (2 * 9 + m2);
            const double left =
                0.5 * (2 * after.first * after.first + m2 * after.second * after.second);
            CHECK(before - left == within(energyLost(2, m2, 4, e), 1e-11));
        }
}

TEST_CASE("truth: the event-driven simulator collides two balls as the formula says, and on time") {
    for (const double m2 : {1.0, 3.0, 1000.0})
        for (const double e : {0.0, 0.5, 1.0}) {
            CAPTURE(m2, e);
            EventDriven simulator(onALine(2, 3, m2, -1, e), {.box = farWalls()});
            simulator.runUntil(1, 1);
            CHECK(simulator.time() == withinShare(0.25, 1e-14));  // 1 m at 4 m/s
            const LineSpeeds expected = headOn(2, 3, m2, -1, e);
            CHECK(simulator.balls()[0].velocity.x == within(expected.first, 1e-13));
            CHECK(simulator.balls()[1].velocity.x == within(expected.second, 1e-13));
        }
}

TEST_CASE("truth: an oblique collision turns the relative velocity by the scattering angle") {
    for (const double b : {0.0, 0.3, 0.9, 0.999})
        for (const double e : {0.4, 1.0}) {
            CAPTURE(b, e);
            Balls balls{{{0, b, 0}, {1, 0, 0}, 0.5, 1, e}, {{3, 0, 0}, {}, 0.5, 7, e}};
            EventDriven simulator(balls, {.box = farWalls()});
            simulator.runUntil(10);
            const Balls after = simulator.balls();
            const Vector relative = after[0].velocity - after[1].velocity;
            const double angle = std::acos(relative.x / length(relative));
            CHECK(angle == within(scatteringAngle(b, 1, e), 1e-7));
            if (e == 1) CHECK(angle == within(2 * std::acos(b), 1e-7));
            CHECK(relative.z == 0);
        }
}

TEST_CASE("truth: a plain sum of impulses changes the energy by the hub-and-spokes formula") {
    const double pocket = std::sqrt(2.0 / 3.0);  // one ball between three that touch
    CHECK(hubAndSpokesEnergy(1, 3 * pocket * pocket, 0.5) == within(3, 1e-12));
    for (const int count : {2, 3, 12})
        for (const double c : {0.2, pocket})
            for (const double spokeMass : {0.1, 1.0, 10.0})
                for (const double e : {0.0, 0.5, 1.0}) {
                    CAPTURE(count, c, spokeMass, e);
                    const double S = count * c * c, B = spokeMass / (spokeMass + 1);
                    const double expected = hubAndSpokesEnergy(e, S, B);
                    CHECK(energyAfterPlainSum(count, c, 1, spokeMass, e) ==
                          within(expected, 1e-12 * (1 + expected)));
                    CHECK(plainSumKeepsEnergy(e, S, B) == (expected <= 1 + 1e-12));
                }
}

TEST_CASE("truth: in Newton's cradle one collision after the other hands on the whole speed") {
    for (const int count : {2, 3, 5, 50}) {
        CAPTURE(count);
        EventDriven events(cradle(count, 1e-3), {.box = farWalls()});
        events.runUntil(2);
        CHECK(events.counts().collisions == static_cast<std::uint64_t>(count - 1));
        CHECK(largestDifference(speedsAlongX(events.balls()), cradleOneByOne(count)) < 1e-12);

        GaussSeidel steps(cradle(count, -1e-6), {.dt = 1e-9, .passes = 1});
        steps.step();
        CHECK(largestDifference(speedsAlongX(steps.balls()), cradleOneByOne(count)) < 1e-12);
    }
}

TEST_CASE("truth: against the order of its contacts, a cradle's pulse moves one ball a pass") {
    GaussSeidel steps(cradle(5, -1e-6), {.dt = 1e-9, .passes = 1, .order = ContactOrder::falling});
    for (std::size_t pass = 1; pass < 5; ++pass) {
        steps.step();
        CHECK(steps.balls()[pass].velocity.x == within(1, 1e-12));
    }
}

TEST_CASE("truth: a cradle solved all at once keeps momentum and energy, and is wrong") {
    for (const int count : {3, 5}) {
        CAPTURE(count);
        Accumulated solver(cradle(count, -1e-6), {.dt = 1e-9, .passes = 500}, 0);
        solver.step();
        CHECK(largestDifference(speedsAlongX(solver.balls()), cradleAtOnce(count, 1)) < 1e-9);
        CHECK(kineticEnergy(solver.balls()) == within(0.5, 1e-9));
        CHECK(momentum(solver.balls()).x == within(1, 1e-12));
    }
    CHECK(cradleAtOnce(5, 1) != cradleOneByOne(5));
}

TEST_CASE("truth: with ever smaller steps the sequential scheme nears the event-driven truth") {
    // A break: one ball into three that stand a little apart.
    const Balls start{{{0, 0.1, 0}, {2, 0, 0}, 0.5, 1, 0.9},
                      {{1.5, 0, 0}, {}, 0.5, 2, 0.8},
                      {{2.4, 0.6, 0.1}, {}, 0.5, 1, 1},
                      {{2.4, -0.6, 0.2}, {}, 0.5, 0.5, 0.7}};
    EventDriven events(start, {.box = farWalls()});
    events.runUntil(2);
    REQUIRE(events.counts().collisions >= 3);
    const auto error = [&](int steps) {
        GaussSeidel scheme(start, {.dt = 2.0 / steps, .passes = 1});
        scheme.run(steps);
        double largest = 0;
        for (std::size_t k = 0; k < start.size(); ++k)
            largest =
                std::max(largest, length(scheme.balls()[k].position - events.balls()[k].position));
        return largest;
    };
    CHECK(error(200) > 1e-3);
    CHECK(error(20000) < 1e-3);
    CHECK(error(200000) < 1e-4);
}
