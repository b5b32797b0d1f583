// Closed forms of falling and bouncing against the sequential scheme and the event-driven
// simulator.
#include "common/random.h"
#include "tests/truth_support.h"
#include "truth/event_driven.h"
#include "truth/gauss_seidel.h"
#include "truth/motion.h"

using namespace ballpit::truth;

namespace {

constexpr double g = 9.81;

StepSettings aboveTheFloor(double dt) {
    StepSettings settings;
    settings.walls.lower.y = 0;
    settings.gravity = {0, -g, 0};
    settings.dt = dt;
    settings.passes = 1;
    return settings;
}

Ball ballAt(double height, double r, double e) { return {{0, height, 0}, {}, r, 1, e}; }

Fall fallOf(const Ball& ball) { return {ball.position.y, ball.velocity.y}; }

/// Mean share of the shadow energy that one elastic bounce from about 1 m takes, and what the
/// formula says at the speeds of these bounces.
struct Loss {
    double measured, expected;
};
Loss meanBounceLoss(StepSettings settings, bool putBack) {
    ballpit::Random random(7);
    Loss mean{0, 0};
    constexpr int drops = 2000;
    for (int k = 0; k < drops; ++k) {
        const double height = 1 + static_cast<double>(random.uniform(0, 0.2f));
        GaussSeidel scheme({ballAt(height, 0.1, 1)}, settings);
        const double before = shadowEnergy({height - 0.1, 0}, g, settings.dt);
        while (scheme.balls()[0].velocity.y <= 0) scheme.step();
        Fall after = fallOf(scheme.balls()[0]);
        after.height -= 0.1;
        mean.measured += (1 - shadowEnergy(after, g, settings.dt) / before) / drops;
        mean.expected += bounceLoss(g, settings.dt, std::sqrt(2 * before), putBack) / drops;
    }
    return mean;
}

}  // namespace

TEST_CASE("truth: steps of semi-implicit Euler fall as their closed form says, damped or not") {
    for (const double damping : {0.0, 0.01, 3.0})
        for (const int steps : {1, 7, 600}) {
            CAPTURE(damping, steps);
            StepSettings settings = aboveTheFloor(1.0 / 60);
            settings.walls = farWalls();
            settings.damping = damping;
            GaussSeidel scheme({{{0, 50, 0}, {0, 4, 0}, 0.5, 1, 1}}, settings);
            scheme.run(steps);
            const Fall expected =
                semiImplicitFall({50, 4}, g, settings.dt, 1 - damping * settings.dt, steps);
            CHECK(scheme.balls()[0].position.y == within(expected.height, 1e-9));
            CHECK(scheme.balls()[0].velocity.y == within(expected.speed, 1e-10));
        }
}

TEST_CASE("truth: the stepped fall errs by -g t dt / 2, first order in dt") {
    const Fall exact = continuousFall({10, 2}, g, 1);
    for (const int steps : {10, 60, 1000}) {
        const double dt = 1.0 / steps;
        const Fall stepped = semiImplicitFall({10, 2}, g, dt, 1, steps);
        CHECK(stepped.height - exact.height == within(semiImplicitFallError(g, 1, dt), 1e-11));
        CHECK(stepped.speed == within(exact.speed, 1e-11));
    }
}

TEST_CASE("truth: in flight the shadow energy stays, the true energy does not") {
    StepSettings settings = aboveTheFloor(1.0 / 60);
    settings.walls = farWalls();
    GaussSeidel scheme({ballAt(10, 0.5, 1)}, settings);
    const double shadow = shadowEnergy({10, 0}, g, settings.dt);
    for (int k = 0; k < 600; ++k) {
        scheme.step();
        REQUIRE(shadowEnergy(fallOf(scheme.balls()[0]), g, settings.dt) ==
                within(shadow, 1e-12 * kineticEnergy(scheme.balls()) + 1e-11));
    }
    const double energy =
        kineticEnergy(scheme.balls()) + potentialEnergy(scheme.balls(), settings.gravity);
    CHECK(std::abs(energy / (g * 10) - 1) > 0.01);
}

TEST_CASE("truth: the event-driven ball rises to the heights h_k = (h0 - r) e^2k + r") {
    const double h0 = 2, r = 0.1, e = 0.8;
    EventDriven simulator({ballAt(h0, r, e)},
                          {.box = {{-9, 0, -9}, {9, 9, 9}}, .gravity = {0, -g, 0}});
    for (int k = 1; k <= 10; ++k) {
        CAPTURE(k);
        simulator.runUntil(1e9, 1);
        const double untilTop = simulator.balls()[0].velocity.y / g;
        simulator.runUntil(simulator.time() + untilTop);
        CHECK(simulator.balls()[0].position.y == within(bounceHeight(h0, r, e, k), 1e-11));
    }
    simulator.runUntil(1e9, 100);
    CHECK(simulator.time() == within(bouncingTime(h0, r, g, e), 1e-8));
}

TEST_CASE("truth: an elastic ball bounces for ever between floor and ceiling") {
    EventDriven simulator({{{0, 1, 0}, {0.3, 7, -0.2}, 0.25, 1, 1}},
                          {.box = {{-1, 0, -1}, {1, 2, 1}}, .gravity = {0, -g, 0}});
    const double energy = 0.5 * (0.09 + 49 + 0.04) + g * 1;
    simulator.runUntil(1e9, 100000);
    CHECK(kineticEnergy(simulator.balls()) + potentialEnergy(simulator.balls(), {0, -g, 0}) ==
          withinShare(energy, 1e-11));
    CHECK(simulator.invalidStates() == 0);
}

TEST_CASE("truth: small steps bounce to nearly the same heights") {
    GaussSeidel scheme({ballAt(1, 0.1, 0.8)}, aboveTheFloor(1e-3));
    for (int k = 1; k <= 3; ++k) {
        while (scheme.balls()[0].velocity.y <= 0) scheme.step();
        while (scheme.balls()[0].velocity.y > 0) scheme.step();
        const double expected = bounceHeight(1, 0.1, 0.8, k);
        CHECK(scheme.balls()[0].position.y == withinShare(expected, 0.02));
        CHECK(scheme.balls()[0].position.y < expected);
    }
}

TEST_CASE(
    "truth: an elastic bounce loses g dt / v of the energy, without putting back twice that") {
    StepSettings putBack = aboveTheFloor(1.0 / 60);
    const Loss once = meanBounceLoss(putBack, true);
    CHECK(once.measured == withinShare(once.expected, 0.05));

    StepSettings inPasses = putBack;
    inPasses.wallTurn = WallTurn::everyPass;
    CHECK(meanBounceLoss(inPasses, true).measured == withinShare(once.measured, 1e-9));

    inPasses.projection = 0;
    const Loss left = meanBounceLoss(inPasses, false);
    CHECK(left.measured == withinShare(left.expected, 0.05));
}
