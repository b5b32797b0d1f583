// The scenes that show one thing each: do they? And every scene is one that the engine takes.
#include "common/motion.h"
#include "tests/support.h"

using namespace ballpit;

namespace {

/// Those of common/scene.h; the catalogue of stability tests has tests of its own.
const std::vector<std::string> ownScenes{"gravity_fall",  "uniform", "gas",
                                         "pile",          "head_on", "static_overlap",
                                         "falling_balls", "break"};

Spheres after(const Scene& scene, int steps) {
    return test::simulate(scene, test::settingsFor(scene, Device::cpu), steps);
}

}  // namespace

TEST_CASE("every scene starts within its world, in cells that are large enough, and loses nobody") {
    const std::string name = GENERATE(from_range(ownScenes));
    const int count = GENERATE(1, 2, 3, 50);
    CAPTURE(name, count);
    const Scene scene = makeScene(name, count, 1);
    CHECK(scene.name == name);
    REQUIRE(scene.spheres.count() == static_cast<std::size_t>(count));
    for (const Vec3 place : scene.spheres.positions) CHECK(contains(scene.bounds, place));
    const Spheres end = after(scene, 5);
    CHECK(measure(end, scene.bounds, scene.gravity, scene.dt).lost == 0);
}

TEST_CASE("an unknown scene is refused, and all are named") {
    const auto message = test::messageOf<InputError>([] { makeScene("gravity", 5, 1); });
    for (const std::string& name : ownScenes) CHECK(test::contains(message, name));
}

TEST_CASE("head_on: blue leaves with (1 + e) / 2 of red's speed, red with (1 - e) / 2") {
    const Scene scene = makeHeadOn(10, 1);
    const Spheres end = after(scene, 120);
    for (std::size_t lane = 0; lane < 5; ++lane) {
        CAPTURE(lane);
        const float e = 0.25f * static_cast<float>(lane);
        CHECK(end.velocities[2 * lane].x == Approx(1.5f * (1 - e)).margin(1e-5));
        CHECK(end.velocities[2 * lane + 1].x == Approx(1.5f * (1 + e)).epsilon(1e-5));
        CHECK(scene.spheres.positions[2 * lane].z == scene.spheres.positions[2 * lane + 1].z);
    }
}

TEST_CASE("falling_balls: two seconds later each ball is at least as high as the one before it") {
    const Spheres end = after(makeFallingBalls(9, 1), 120);
    for (std::size_t k = 1; k < 9; ++k) {
        CAPTURE(k);
        CHECK(end.positions[k].y >= end.positions[k - 1].y);
    }
    CHECK(end.positions[0].y == 0.5f);
    CHECK(end.positions[8].y > 5.0f);
}

TEST_CASE("static_overlap: balls deep in each other come apart and never move by themselves") {
    const Scene scene = makeStaticOverlap(100, 1);
    const auto penetration = [&](const Spheres& balls) {
        return measure(balls, scene.bounds, {}, scene.dt).largestPenetration;
    };
    const Spheres end = after(scene, 300);
    CHECK(penetration(scene.spheres) > 0.8);
    CHECK(test::bruteForcePairs(scene.spheres).size() > 100 * 20 / 2);  // each in 20 others
    CHECK(penetration(end) < 0.02);
    CHECK(measure(end, scene.bounds, {}, scene.dt).kineticEnergy == 0.0);
}

TEST_CASE("break: one ball comes, all others rest, and they touch each other") {
    const Scene scene = makeScene("break", sceneKind("break").usualCount, 1);
    for (std::size_t k = 0; k < scene.spheres.count(); ++k)
        CHECK((length(scene.spheres.velocities[k]) > 0) == (k == 0));
    CHECK(test::bruteForcePairs(scene.spheres).size() == 30);
    CHECK(measure(after(scene, 200), scene.bounds, {}, scene.dt).kineticEnergy <
          1.0001 * measure(scene.spheres, scene.bounds, {}, scene.dt).kineticEnergy);
}

TEST_CASE("drifting balls go straight, turn back at the walls and never leave") {
    const Bounds world{{-1, -2, -3}, {1, 2, 3}};
    Spheres balls;
    balls.add({0.95f, 0, 0}, {6, 0, -3}, 0.1f, 1, 1);
    drift(balls, world);
    CHECK(balls.positions[0] == Vec3{1, 0, -0.05f});
    CHECK(balls.velocities[0] == Vec3{-6, 0, -3});
    for (int k = 0; k < 19; ++k) balls.add({}, {}, 0.1f, 1, 1);
    stir(balls, {5, 0, 5}, 3);
    for (int frame = 0; frame < 300; ++frame) drift(balls, world);
    for (const Vec3 place : balls.positions) CHECK(contains(world, place));
    for (const Vec3 velocity : balls.velocities) CHECK(velocity.y == 0.0f);
}

TEST_CASE("the same seed stirs alike, another one differently") {
    const auto stirred = [](std::uint64_t seed) {
        Spheres balls;
        for (int k = 0; k < 5; ++k) balls.add({}, {}, 0.1f, 1, 1);
        stir(balls, {5, 0, 5}, seed);
        return balls.velocities;
    };
    CHECK(stirred(3) == stirred(3));
    CHECK_FALSE(stirred(3) == stirred(4));
}

TEST_CASE("balls appear by number: none at first, the front half first, all at three quarters") {
    Spheres balls;
    for (int k = 0; k < 100; ++k) balls.add({}, {}, 0.5f, 1, 1);
    const std::vector<float> radii = balls.radii;
    showFirst(balls, radii, 0.0f);
    CHECK(balls.radii == std::vector<float>(100, 0.0f));
    showFirst(balls, radii, 0.4f);
    CHECK(balls.radii[20] == 0.5f);
    CHECK(balls.radii[80] == 0.0f);
    showFirst(balls, radii, 0.75f);
    CHECK(balls.radii == radii);
}
