// Balls that start inside each other, at rest and without gravity: they must be pushed apart
// without gaining any speed, without moving their centre of mass, and without anything ever being
// divided by a distance of zero.
#include "common/random.h"
#include "tests/support.h"

using namespace ballpit;

namespace {

constexpr float radius = 0.5f;

/// Balls of unequal masses, so that a centre of mass computed without them would show.
void addAtRest(Scene& scene, Vec3 position) {
    const float mass = 1.0f + static_cast<float>(scene.spheres.count() % 3);
    scene.spheres.add(position, {}, radius, mass, 0.5f);
}

Scene line(int count, float spacing) {
    Scene scene = test::emptyWorld();
    for (int k = 0; k < count; ++k)
        addAtRest(scene, {spacing * (static_cast<float>(k) - 0.5f * static_cast<float>(count)),
                          0.1f, -0.2f});
    return scene;
}

Scene lattice(int side, float spacing) {
    Scene scene = test::emptyWorld();
    for (int k = 0; k < side * side * side; ++k)
        addAtRest(scene,
                  spacing * Vec3{static_cast<float>(k % side), static_cast<float>(k / side % side),
                                 static_cast<float>(k / side / side)});
    return scene;
}

/// All within a cube of `size` m.
Scene cluster(int count, float size, std::uint64_t seed) {
    Scene scene = test::emptyWorld();
    Random random(seed);
    for (int k = 0; k < count; ++k)
        addAtRest(scene, random.uniformIn({{0, 0, 0}, {size, size, size}}));
    return scene;
}

Vec3d centreOfMass(const Spheres& spheres) {
    Vec3d sum;
    double mass = 0.0;
    for (std::size_t k = 0; k < spheres.count(); ++k) {
        const double m = spheres.masses[k];
        const Vec3 p = spheres.positions[k];
        sum = {sum.x + m * p.x, sum.y + m * p.y, sum.z + m * p.z};
        mass += m;
    }
    return {sum.x / mass, sum.y / mass, sum.z / mass};
}

double largestPenetration(const Scene& scene, const Spheres& spheres) {
    return measure(spheres, scene.bounds, scene.gravity, scene.dt).largestPenetration;
}

/// What holds for every group of balls at rest: still at rest, still there, still centred.
Spheres settle(const Scene& scene, Device device, int steps) {
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), steps);
    const Metrics after = measure(end, scene.bounds, scene.gravity, scene.dt);
    CHECK(after.kineticEnergy == 0.0);
    CHECK(after.lost == 0);
    CHECK(after.notFinite == 0);
    const Vec3d before = centreOfMass(scene.spheres), now = centreOfMass(end);
    CHECK(length(Vec3d{now.x - before.x, now.y - before.y, now.z - before.z}) < 1e-5);
    return end;
}

}  // namespace

TEST_CASE(
    "two overlapping balls at rest are apart after one step, moved in inverse proportion "
    "to their masses") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld();
    scene.spheres.add({0, 0, 0}, {}, radius, 1.0f, 0.5f);
    scene.spheres.add({0.6f, 0, 0}, {}, radius, 3.0f, 0.5f);
    const Spheres end = settle(scene, device, 1);
    CHECK(end.positions[0].x == Approx(-0.3).margin(1e-6));
    CHECK(end.positions[1].x == Approx(0.7).margin(1e-6));
    CHECK(largestPenetration(scene, end) < 1e-6);
}

TEST_CASE("a small group of overlapping balls comes apart") {
    const Device device = GENERATE(from_range(test::devices()));
    SECTION("three in a line") {
        const Scene scene = line(3, 0.7f);
        CHECK(largestPenetration(scene, settle(scene, device, 60)) < 1e-3 * radius);
    }
    SECTION("eight in a cube") {
        const Scene scene = lattice(2, 0.8f);
        CHECK(largestPenetration(scene, settle(scene, device, 60)) < 1e-3 * radius);
    }
    SECTION("eight at random") {
        const std::uint64_t seed = GENERATE(range(1, 11));
        CAPTURE(seed);
        const Scene scene = cluster(8, 1.0f, seed);
        CHECK(largestPenetration(scene, settle(scene, device, 60)) < 1e-3 * radius);
    }
}

TEST_CASE("a large group of overlapping balls comes apart, if slowly") {
    const Device device = GENERATE(from_range(test::devices()));
    SECTION("27 in a cube") {
        const Scene scene = lattice(3, 0.9f);
        CHECK(largestPenetration(scene, settle(scene, device, 200)) < 1e-3 * radius);
    }
    SECTION("64 in a cube") {
        const Scene scene = lattice(4, 0.9f);
        CHECK(largestPenetration(scene, settle(scene, device, 200)) < 1e-3 * radius);
    }
    SECTION("27 or 64 at random") {
        const int count = GENERATE(27, 64);
        const std::uint64_t seed = GENERATE(range(1, 6));
        CAPTURE(count, seed);
        const Scene scene = cluster(count, 2.0f, seed);
        CHECK(largestPenetration(scene, settle(scene, device, 200)) < 1e-3 * radius);
    }
}

TEST_CASE("two balls with the same centre part along y, the smaller number below") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld();
    const Vec3 centre{0.25f, 0.5f, -0.75f};
    scene.spheres.add(centre, {}, radius, 1.0f, 0.5f);
    scene.spheres.add(centre, {}, radius, 1.0f, 0.5f);
    const Spheres end = settle(scene, device, 1);
    CHECK(end.positions[0] == Vec3{0.25f, 0.0f, -0.75f});
    CHECK(end.positions[1] == Vec3{0.25f, 1.0f, -0.75f});
}

TEST_CASE("which of two coincident balls goes down does not depend on where they came from") {
    const Device device = GENERATE(from_range(test::devices()));
    const bool smallerFromTheRight = GENERATE(false, true);
    CAPTURE(smallerFromTheRight);
    // All values are sums of a few powers of two, so that the centres meet exactly at x = 2.5 in
    // the second step. In the first the balls are in two cells, which puts the left one first in
    // memory.
    Scene scene = test::emptyWorld(2.0f);
    scene.dt = 1.0f / 64.0f;
    scene.spheres.add({1.25f, 0, 0}, {40, 0, 0}, radius, 1.0f, 0.5f);
    scene.spheres.add({3.5f, 0, 0}, {-32, 0, 0}, radius, 1.0f, 0.5f);
    if (smallerFromTheRight) {
        std::swap(scene.spheres.positions[0], scene.spheres.positions[1]);
        std::swap(scene.spheres.velocities[0], scene.spheres.velocities[1]);
    }
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), 2);
    CHECK(end.positions[0] == Vec3{2.5f, -0.5f, 0});
    CHECK(end.positions[1] == Vec3{2.5f, 0.5f, 0});
}

// A column of n balls comes apart as heat spreads: in a time that grows as n^2.
TEST_CASE("any number of balls with the same centre come apart without NaN") {
    const Device device = GENERATE(from_range(test::devices()));
    const int count = GENERATE(3, 8, 27, 64);
    CAPTURE(count);
    Scene scene = test::emptyWorld();
    scene.bounds = {{-10, -100, -10}, {10, 100, 10}};  // they end as a column along y
    for (int k = 0; k < count; ++k) addAtRest(scene, {0, 0, 0});
    double before = largestPenetration(scene, scene.spheres);
    for (const int steps : {30, 300, 3000}) {
        const double now = largestPenetration(scene, settle(scene, device, steps));
        CHECK(now < before + 1e-5 * radius);
        before = now;
    }
    CHECK(before < (count < 64 ? 1e-3 : 0.1) * radius);
}
