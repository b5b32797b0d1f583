// What looking for contacts only at the end of each step costs: the closed forms against many
// single encounters of two balls in the sequential scheme.
#include <numbers>

#include "common/random.h"
#include "tests/truth_support.h"
#include "truth/collisions.h"
#include "truth/gauss_seidel.h"

using namespace ballpit::truth;

namespace {

/// What many encounters come to. Speed 1 m/s, radius 0.5 m, equal masses, elastic.
struct Encounters {
    double appliedShare = 0;      ///< of all
    double angleError = 0;        ///< rad, root mean square over those with an impulse
    double transferred = 0;       ///< m/s: mean change of the speed along the flight, of the same
    double transferredTruly = 0;  ///< the same for impulses exactly at first contact
};

/// The impact parameter is uniform over the disc, the contact uniform over the step; in that step
/// the balls either collide or pass: they cannot meet again.
Encounters encounters(double dt, int count) {
    ballpit::Random random(11);
    const auto uniform = [&] { return static_cast<double>(random.uniform(0, 1)); };
    Encounters result;
    double applied = 0;
    for (int k = 0; k < count; ++k) {
        const double b = std::sqrt(uniform()), before = dt * uniform();
        const double x = -std::sqrt(1 - b * b) - before;
        GaussSeidel scheme({{{x, b, 0}, {1, 0, 0}}, {{0, 0, 0}, {}}}, {.dt = dt, .passes = 1});
        scheme.step();
        if (scheme.counts().impulses == 0) continue;
        applied += 1;
        const Vector relative = scheme.balls()[0].velocity - scheme.balls()[1].velocity;
        const double error = std::acos(relative.x / length(relative)) - scatteringAngle(b, 1, 1);
        result.angleError += error * error;
        result.transferred += 1 - scheme.balls()[0].velocity.x;
        result.transferredTruly += 1 - b * b;
    }
    result.appliedShare = applied / count;
    result.angleError = std::sqrt(result.angleError / applied);
    result.transferred /= applied;
    result.transferredTruly /= applied;
    return result;
}

}  // namespace

TEST_CASE("truth: the share of impacts that get an impulse is 1 - u^2/3, or 2/(3u) beyond 1") {
    constexpr int count = 20000;
    for (const double u : {0.2, 0.5, 1.0, 2.0, 8.0}) {
        CAPTURE(u);
        const double expected = impulseAppliedShare(u);
        const double spread = std::sqrt(expected * (1 - expected) / count);
        CHECK(encounters(u, count).appliedShare == within(expected, 3 * spread + 1.0 / count));
    }
    CHECK(impulseAppliedShare(1) == withinShare(2.0 / 3, 1e-15));
}

TEST_CASE(
    "truth: a late normal turns balls wrongly by s / sqrt(6), and passes on 4 s / 15 too little") {
    for (const double s : {0.02, 0.1}) {  // v dt / r; the diameter is 1 m
        CAPTURE(s);
        const Encounters found = encounters(s / 2, 40000);
        CHECK(found.angleError == withinShare(lateNormalAngleError(s), 0.05));
        CHECK(1 - found.transferred / found.transferredTruly ==
              withinShare(lateNormalMomentumDeficit(s), 0.05));
    }
}
