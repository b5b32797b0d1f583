// The metrics of stability/ against cases small enough to work out by hand.
#include <cmath>
#include <limits>
#include <numbers>

#include "stability/metrics.h"
#include "tests/catch.h"

using namespace ballpit;
using namespace ballpit::stability;

namespace {

constexpr Bounds world{{-10, -10, -10}, {10, 10, 10}};
constexpr double pi = std::numbers::pi;

Spheres ballsAt(const std::vector<Vec3>& places) {
    Spheres spheres;
    for (const Vec3 place : places) spheres.add(place, {}, 0.5f, 1, 1);
    return spheres;
}

Spheres ballsWith(const std::vector<Vec3>& velocities) {
    Spheres spheres;
    for (std::size_t k = 0; k < velocities.size(); ++k)
        spheres.add({2.0f * static_cast<float>(k), 0, 0}, velocities[k], 0.5f, 1, 1);
    return spheres;
}

}  // namespace

TEST_CASE("overlaps of balls and walls add up as squares, in radii, a ball") {
    // 0.25 m between the first two; the third 0.125 m in the floor and in a side wall; the fourth
    // free. sqrt((1/16 + 2/64) / 4) / 0.5
    const Spheres balls = ballsAt({{0, 0, 0}, {0.75f, 0, 0}, {9.625f, -9.625f, 0}, {0, 5, 0}});
    const Overlap overlap = overlapOf(balls, world);
    CHECK(overlap.contacts == 1);
    CHECK(overlap.wallContacts == 2);
    CHECK(overlap.rms == Approx(std::sqrt((0.0625 + 2 * 0.015625) / 4) / 0.5));
    CHECK(overlap.max == Approx(0.5));
}

TEST_CASE("twice as many of the same overlaps leave their rms as it is") {
    const Spheres two = ballsAt({{0, 0, 0}, {0.75f, 0, 0}});
    const Spheres four = ballsAt({{0, 0, 0}, {0.75f, 0, 0}, {0, 5, 0}, {0.75f, 5, 0}});
    CHECK(overlapOf(four, world).rms == Approx(overlapOf(two, world).rms));
}

TEST_CASE("overlaps are measured in mean radii, and without bodies that are not finite") {
    Spheres balls = ballsAt({{0, 0, 0}, {1, 0, 0}});
    balls.radii = {0.25f, 1.0f};
    CHECK(overlapOf(balls, world).max == Approx(0.25 / 0.625));
    balls.positions[1].y = std::numeric_limits<float>::quiet_NaN();
    CHECK(overlapOf(balls, world).max == 0.0);
    CHECK(overlapOf(Spheres{}, world).rms == 0.0);
}

TEST_CASE("an energy's drift has a sign in its mean and none in its largest") {
    EnergyDrift drift(-8.0);
    CHECK(drift.mean() == 0.0);
    for (const double energy : {-8.0, -6.0, -16.0}) drift.add(energy);
    CHECK(drift.last() == Approx(-1.0));
    CHECK(drift.mean() == Approx((0.0 + 0.25 - 1.0) / 3));
    CHECK(drift.largest() == Approx(1.0));
}

TEST_CASE("a momentum error of 1 is all balls flying the same way") {
    const Spheres before = ballsWith({{3, 0, 0}, {-3, 0, 0}});
    CHECK(momentumError(before, before) == 0.0);
    CHECK(momentumError(before, ballsWith({{3, 0, 0}, {3, 0, 0}})) == Approx(1.0));
    // 0.6 kg m/s of 2 * sqrt(9 J * 2 kg) = 6
    CHECK(momentumError(before, ballsWith({{3, 0.6f, 0}, {-3, 0, 0}})) == Approx(0.1));
}

TEST_CASE("missed impulses are a share of those expected") {
    CHECK(missedShare(10, 10) == 0.0);
    CHECK(missedShare(9, 12) == Approx(0.25));
}

TEST_CASE("balls outside are lost, and those without a number are counted apart") {
    Spheres balls = ballsAt({{10, 0, 0}, {10.5f, 0, 0}, {0, -11, 0}, {0, 0, 0}});
    balls.velocities[3].z = std::numeric_limits<float>::infinity();
    CHECK(lossesOf(balls, world).lost == 2);
    CHECK(lossesOf(balls, world).notFinite == 1);
    balls.positions[1].x = std::numeric_limits<float>::quiet_NaN();
    CHECK(lossesOf(balls, world).lost == 1);
    CHECK(lossesOf(balls, world).notFinite == 2);
}

TEST_CASE("temperature, mean free time and pressure of a gas follow from each other") {
    Spheres balls = ballsWith({{3, 0, 0}, {0, 0, -3}});
    balls.masses = {2, 4};
    CHECK(temperatureOf(balls) == Approx((2 * 9 + 4 * 9) / 2.0 / 3.0));
    CHECK(meanFreeTime(100, 3.0, 50) == Approx(3.0));
    // An ideal gas has no collisions.
    CHECK(compressibilityFrom(1e12, 1, 1, 1) == Approx(1.0));
    // Carnahan and Starling at 0.2618: Z = 3.2624, mean free time 0.13057 (sigma = m = T = 1).
    CHECK(compressibilityFrom(0.13057, 1, 1, 1) == Approx(3.2624).epsilon(1e-3));
    // 4 m a diameter of 2 m takes twice as long, 4 kg at 1 J move half as fast.
    CHECK(compressibilityFrom(4 * 0.13057, 2, 4, 1) == Approx(3.2624).epsilon(1e-3));
}

TEST_CASE("velocities like Maxwell's are near his law, and equal speeds are not") {
    // Quantiles of the normal distribution: the best sample that there can be.
    Spheres normal, equal;
    for (int k = 0; k < 300; ++k) {
        const auto quantile = [&](int n) {
            double low = -6, high = 6;
            for (int step = 0; step < 60; ++step) {
                const double v = 0.5 * (low + high);
                (0.5 * std::erfc(-v / std::sqrt(2.0)) < (n + 0.5) / 900 ? low : high) = v;
            }
            return static_cast<float>(low);
        };
        normal.add({}, {quantile(3 * k), quantile(3 * k + 1), quantile(3 * k + 2)}, 0.5f, 1, 1);
        const float s = k % 2 == 0 ? 1.0f : -1.0f;
        equal.add({}, {s, s, -s}, 0.5f, 1, 1);
    }
    CHECK(maxwellDistance(normal) < 0.002);
    // All at +-1, the standard deviation: half of them at once at -1, where his law has 0.1587.
    CHECK(maxwellDistance(equal) == Approx(0.5 - 0.158655).epsilon(1e-4));
}

TEST_CASE("a gas that has cooled as Haff says has the ratio 1") {
    CHECK(haffRatio(0.25 * 7, 7, 3.0, 3.0) == Approx(1.0));
    CHECK(haffRatio(7, 7, 3.0, 3.0) == Approx(4.0));
}

TEST_CASE("the packing fraction counts the parts of balls that lie in the slab") {
    const Bounds box{{0, 0, 0}, {1, 4, 1}};
    Spheres balls = ballsAt({{0.5f, 1, 0.5f}});
    CHECK(packingFraction(balls, box, 0, 4) == Approx(pi / 6 / 4));
    CHECK(packingFraction(balls, box, 0, 1) == Approx(pi / 12));
    CHECK(packingFraction(balls, box, 1.5, 3) == Approx(0.0).margin(1e-12));
    // Its lowest quarter: a cap of pi h^2 (3r - h) / 3 with h = 1/4.
    CHECK(packingFraction(balls, box, 0, 0.75) == Approx(pi * 0.0625 * 1.25 / 3 / 0.75));
}

TEST_CASE("coordination counts two for every contact, and gaps up to the slack") {
    const Spheres row = ballsAt({{0, 0, 0}, {0.99f, 0, 0}, {2.0f, 0, 0}});  // gap: 0.01 m = 0.02 r
    CHECK(coordination(row, 0.0) == Approx(2.0 / 3));
    CHECK(coordination(row, 0.01) == Approx(2.0 / 3));
    CHECK(coordination(row, 0.03) == Approx(4.0 / 3));
}

TEST_CASE("balls that move with what gravity adds in a step have a noise of 1") {
    CHECK(velocityNoise(ballsWith({{0, -0.5f, 0}, {0, 0.5f, 0}}), 10, 0.05) == Approx(1.0));
    CHECK(velocityNoise(ballsWith({{0, 0, 0}, {0, 0.5f, 0}}), 10, 0.05) == Approx(std::sqrt(0.5)));
}

TEST_CASE("two runs are compared by distance and by bits") {
    const Spheres a = ballsAt({{0, 0, 0}, {1, 2, 3}});
    Spheres b = a;
    CHECK(sameBits(a, b));
    b.velocities[0].x = 1e-30f;
    CHECK(largestDistance(a, b) == 0.0);
    CHECK_FALSE(sameBits(a, b));
    b.positions[1] = {1, 5, 7};
    CHECK(largestDistance(a, b) == Approx(5.0));
}

TEST_CASE("a cost is a second's: time, pair visits, and how much faster than real time") {
    const Cost cost{.milliseconds = 500, .simulatedSeconds = 2, .pairVisits = 6000};
    CHECK(cost.millisecondsASecond() == Approx(250));
    CHECK(cost.pairVisitsASecond() == Approx(3000));
    CHECK(cost.realTimeFactor() == Approx(4));
}
