// The metrics against examples small enough to work out by hand, and the host's pair search against
// brute force.
#include <cmath>
#include <limits>

#include "common/host_pairs.h"
#include "common/random.h"
#include "tests/support.h"

using namespace ballpit;

namespace {

constexpr Bounds world{{-10, -10, -10}, {10, 10, 10}};
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Two balls that overlap by 0.25 m, and one far from both.
Spheres threeBalls() {
    Spheres spheres;
    spheres.add({1, 2, 3}, {2, 0, 0}, 0.5f, 3.0f, 1.0f);
    spheres.add({1, 2, 3.75f}, {0, -1, 0}, 0.5f, 2.0f, 1.0f);
    spheres.add({-5, 0, 0}, {0, 0, 4}, 1.0f, 0.5f, 1.0f);
    return spheres;
}

Spheres randomSpheres(int count, float side, float largestRadius, std::uint64_t seed) {
    Random random(seed);
    Spheres spheres;
    for (int k = 0; k < count; ++k) {
        const Vec3 position = random.uniformIn({{-side, -side, -side}, {side, side, side}});
        spheres.add(position, {}, random.uniform(0.0f, largestRadius), 1.0f, 1.0f);
    }
    return spheres;
}

/// `change` applied to copies of each float of the positions and velocities in turn.
template <class Visit>
void forEachValue(const Spheres& spheres, Visit visit) {
    for (std::size_t k = 0; k < spheres.count(); ++k)
        for (auto field : {&Spheres::positions, &Spheres::velocities})
            for (auto coordinate : {&Vec3::x, &Vec3::y, &Vec3::z}) {
                Spheres changed = spheres;
                visit(changed, (changed.*field)[k].*coordinate);
            }
}

}  // namespace

TEST_CASE("energies and momenta of three balls are those worked out by hand") {
    const Metrics m = measure(threeBalls(), world, {0, -10, 0}, 0.5f);
    CHECK(m.kineticEnergy == Approx(0.5 * 3 * 4 + 0.5 * 2 * 1 + 0.5 * 0.5 * 16));
    // Heights above the floor at y = -10: 12, 12 and 10 m.
    CHECK(m.potentialEnergy == Approx(10.0 * (3 * 12 + 2 * 12 + 0.5 * 10)));
    // Of the velocities only the second has a part along gravity: 2 kg * 0.5 s * (10 * 1) / 2.
    CHECK(m.shadowEnergy == Approx(m.kineticEnergy + m.potentialEnergy + 5.0));
    CHECK(m.momentum.x == 6.0);
    CHECK(m.momentum.y == -2.0);
    CHECK(m.momentum.z == 2.0);
    // x cross v: (1,2,3)x(2,0,0) = (0,6,-4); (1,2,3.75)x(0,-1,0) = (3.75,0,-1);
    // (-5,0,0)x(0,0,4) = (0,20,0).
    CHECK(m.angularMomentum.x == Approx(2 * 3.75));
    CHECK(m.angularMomentum.y == Approx(3 * 6 + 0.5 * 20));
    CHECK(m.angularMomentum.z == Approx(3 * -4 + 2 * -1));
    CHECK(length(m.momentum) == Approx(std::sqrt(44.0)));
}

TEST_CASE("the shadow energy does not change in free fall, the real one does") {
    Spheres spheres;
    spheres.add({0, 5, 0}, {1, 2, 0}, 0.5f, 3.0f, 1.0f);
    const float dt = 0.25f;
    const Vec3 gravity{0, -8, 0};
    const Metrics before = measure(spheres, world, gravity, dt);
    spheres.velocities[0] += dt * gravity;
    spheres.positions[0] += dt * spheres.velocities[0];
    const Metrics after = measure(spheres, world, gravity, dt);
    CHECK(after.shadowEnergy == Approx(before.shadowEnergy).epsilon(1e-12));
    CHECK(std::abs(after.kineticEnergy + after.potentialEnergy - before.kineticEnergy -
                   before.potentialEnergy) > 1.0);
}

TEST_CASE("contacts and penetrations of three balls are those worked out by hand") {
    Spheres spheres = threeBalls();
    CHECK(measure(spheres, world, {}, 1.0f).contacts == 1);
    CHECK(measure(spheres, world, {}, 1.0f).largestPenetration == Approx(0.25));
    CHECK(measure(spheres, world, {}, 1.0f).meanPenetration == Approx(0.25));
    spheres.positions[2] = {1, 2, 4.25f};  // overlaps the second by 1 m and the first by 0.25 m
    const Metrics m = measure(spheres, world, {}, 1.0f);
    CHECK(m.contacts == 3);
    CHECK(m.largestPenetration == Approx(1.0));
    CHECK(m.meanPenetration == Approx((0.25 + 1.0 + 0.25) / 3.0));
}

TEST_CASE("a ball's penetration of each wall is measured") {
    const Vec3 direction = GENERATE(Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0},
                                    Vec3{0, 0, 1}, Vec3{0, 0, -1});
    CAPTURE(direction);
    Spheres spheres;
    spheres.add(9.75f * direction, {}, 0.5f, 1.0f, 1.0f);
    CHECK(measure(spheres, world, {}, 1.0f).largestPenetration == Approx(0.25));
    CHECK(measure(spheres, world, {}, 1.0f).contacts == 0);
    spheres.positions[0] = 9.0f * direction;
    CHECK(measure(spheres, world, {}, 1.0f).largestPenetration == 0.0);
}

TEST_CASE("a ball is lost when its centre is outside the world, not on its wall") {
    Spheres spheres = threeBalls();
    spheres.positions[0] = {10, -10, 10};
    CHECK(measure(spheres, world, {}, 1.0f).lost == 0);
    const Vec3 outside = GENERATE(Vec3{10.001f, 0, 0}, Vec3{0, -10.001f, 0}, Vec3{0, 0, 1e30f});
    CAPTURE(outside);
    spheres.positions[2] = outside;
    CHECK(measure(spheres, world, {}, 1.0f).lost == 1);
}

TEST_CASE("bodies that are not finite are counted and left out of the sums") {
    const std::vector<float> badValues{infinity, -infinity,
                                       std::numeric_limits<float>::quiet_NaN()};
    const float bad = GENERATE_COPY(from_range(badValues));
    CAPTURE(bad);
    const Metrics before = measure(threeBalls(), world, {0, -10, 0}, 0.5f);
    forEachValue(threeBalls(), [&](Spheres& changed, float& value) {
        value = bad;
        const Metrics m = measure(changed, world, {0, -10, 0}, 0.5f);
        CHECK(m.notFinite == 1);
        CHECK(m.lost == 0);
        CHECK(m.kineticEnergy < before.kineticEnergy);
        CHECK(std::isfinite(m.shadowEnergy));
    });
}

TEST_CASE("the state hash of a given state is a given number") {
    Spheres spheres;
    CHECK(hashText(stateHash(spheres)) == "cbf29ce484222325");
    spheres.add({1, 2, 3}, {-4, 5.5f, 0}, 0.5f, 1.0f, 1.0f);
    spheres.add({0.1f, -0.0f, 1e-40f}, {7, 8, 9}, 0.5f, 1.0f, 1.0f);
    CHECK(hashText(stateHash(spheres)) == "bb1b4abefa15a24e");
    CHECK(hashText(0xABC) == "0000000000000abc");
}

TEST_CASE("the state hash tells states apart by a single bit of any position or velocity") {
    const Spheres spheres = threeBalls();
    const std::uint64_t before = stateHash(spheres);
    forEachValue(spheres, [&](Spheres& changed, float& value) {
        CHECK(stateHash(changed) == before);
        value = std::nextafter(value, 100.0f);
        CHECK(stateHash(changed) != before);
    });
    Spheres signOfZero = spheres;
    signOfZero.positions[2].y = -0.0f;
    CHECK(stateHash(signOfZero) != before);
    Spheres swapped = spheres;
    std::swap(swapped.positions[0], swapped.positions[1]);
    CHECK(stateHash(swapped) != before);
}

TEST_CASE("the host's pair search finds the same pairs as brute force") {
    const std::uint64_t seed = GENERATE(range(1, 21));
    const float largestRadius = GENERATE(0.2f, 1.0f);
    CAPTURE(seed, largestRadius);
    const Spheres spheres = randomSpheres(400, 3.0f, largestRadius, seed);
    const std::vector<Pair> expected = test::bruteForcePairs(spheres);
    REQUIRE(expected.size() > 10);
    CHECK(findPairsOnHost(spheres) == expected);
}

TEST_CASE("the host's pair search does not miss balls that touch across its cells") {
    Spheres spheres;
    for (int k = 0; k < 1000; ++k)
        spheres.add({static_cast<float>(k) * (1.0f - 1e-6f), 0, 0}, {}, 0.5f, 1.0f, 1.0f);
    CHECK(findPairsOnHost(spheres) == test::bruteForcePairs(spheres));
}

TEST_CASE("the host's pair search copes with no balls, one, points, coincident and far ones") {
    Spheres spheres;
    CHECK(findPairsOnHost(spheres).empty());
    spheres.add({1e6f, -1e6f, 0}, {}, 0.5f, 1.0f, 1.0f);
    CHECK(findPairsOnHost(spheres).empty());
    spheres.add({1e6f, -1e6f, 0}, {}, 0.5f, 1.0f, 1.0f);
    spheres.add({0, 0, 0}, {}, 0.0f, 1.0f, 1.0f);
    spheres.add({0, 0, 0}, {}, 0.0f, 1.0f, 1.0f);  // two points never touch: 0 < 0 is false
    spheres.add({infinity, 0, 0}, {}, 0.5f, 1.0f, 1.0f);
    CHECK(findPairsOnHost(spheres) == std::vector<Pair>{{0, 1}});
}
