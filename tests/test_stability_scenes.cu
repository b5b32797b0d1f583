// The scenes of stability/: the same bits each time, and what each promises about its start.
#include <cmath>
#include <set>

#include "common/error.h"
#include "stability/catalogue.h"
#include "stability/metrics.h"
#include "stability/scenes.h"
#include "tests/support.h"
#include "truth/collisions.h"

using namespace ballpit;
using namespace ballpit::stability;

namespace {

double deepest(const Scene& scene) { return overlapOf(scene.spheres, scene.bounds).max; }

/// The state after one step in which all contacts of the balls are resolved once.
Spheres afterOneStep(const Scene& scene) {
    SimulatorSettings settings = settingsFor(scene, Device::cpu);
    settings.iterations = 1;
    return test::simulate(scene, settings, 1);
}

}  // namespace

TEST_CASE(
    "every scene of the catalogue is made by its name, twice the same, and can be simulated") {
    std::set<std::string> names;
    for (const Entry& entry : catalogue()) {
        CAPTURE(entry.name);
        CHECK(names.insert(entry.name).second);
        const Scene scene = makeScene(entry.name, entry.usualCount, 3);
        CHECK(scene.name == entry.name);
        CHECK(scene.spheres.count() == std::size_t(entry.usualCount));
        CHECK(sameBits(scene.spheres, makeScene(entry.name, entry.usualCount, 3).spheres));
        CHECK(std::string(entry.question).back() == '?');
        CHECK_FALSE(std::string(entry.tolerance).empty());
        if (std::string(entry.name) != "not_finite")
            CHECK(afterOneStep(scene).count() == scene.spheres.count());
    }
}

TEST_CASE("scenes with a seed are others with another seed") {
    for (const char* name : {"elastic_gas", "cooling_gas", "six_cubed", "deep_pile", "mixed_radii",
                             "one_cell", "outside"}) {
        CAPTURE(name);
        const int count = sceneKind(name).usualCount;
        CHECK_FALSE(sameBits(makeScene(name, count, 1).spheres, makeScene(name, count, 2).spheres));
    }
}

TEST_CASE("an unknown scene is refused with the list, a wrong number of balls with the right one") {
    const std::string unknown =
        test::messageOf<InputError>([] { makeScene("six_squared", 10, 1); });
    CHECK(test::contains(unknown, "six_squared"));
    for (const Entry& entry : catalogue()) CHECK(test::contains(unknown, entry.name));
    CHECK(test::contains(unknown, "gravity_fall"));
    CHECK(test::messageOf<InputError>([] { makeScene("bounce", 50, 1); }) ==
          "count 50: the scene bounce has 49 balls");
    CHECK(test::messageOf<InputError>([] { makeScene("hub", 14, 1); }) ==
          "count 14: the scene hub has 2 to 13 balls");
}

TEST_CASE("scenes that should start without overlap do") {
    for (const char* name : {"two_bodies", "bounce", "newtons_cradle", "newtons_cradle_reversed",
                             "pocket", "hub", "elastic_gas", "cooling_gas", "six_cubed",
                             "six_cubed_elastic", "deep_pile", "mixed_radii", "bullet"}) {
        CAPTURE(name);
        CHECK(deepest(makeScene(name, sceneKind(name).usualCount, 1)) < 1e-5);
    }
    for (const float share : {0.05f, 0.2f, 0.4f, 0.49f}) {
        CAPTURE(share);
        CHECK(deepest(makeGasOf({.volumeShare = share})) == 0.0);
    }
    for (const int spokes : {1, 2, 3, 6, 12}) {
        CAPTURE(spokes);
        CHECK(deepest(makeHub({.spokes = spokes})) < 1e-5);
    }
}

TEST_CASE("a gas has the share of volume, the speed and the step that were asked for") {
    const Scene scene = makeGasOf({.count = 216, .volumeShare = 0.2f, .travel = 0.05f});
    CHECK(packingFraction(scene.spheres, scene.bounds, 0, scene.bounds.upper.y) ==
          Approx(0.2).epsilon(1e-5));
    CHECK(temperatureOf(scene.spheres) == Approx(1.0).epsilon(1e-5));
    CHECK(scene.dt * gasSpeed / ballRadius == Approx(0.05));
    CHECK(length(measure(scene.spheres, scene.bounds, {}, 0).momentum) < 1e-3);
}

TEST_CASE("two bodies meet in the first step, at the place that offset and phase say") {
    for (const float phase : {0.25f, 1.0f})
        for (const float offset : {0.0f, 0.6f}) {
            CAPTURE(phase, offset);
            const Scene scene = makeTwoBodies({.offset = offset, .travel = 0.2f, .phase = phase});
            Spheres moved = scene.spheres;
            moved.positions[0] += scene.dt * moved.velocities[0];
            const float line = std::sqrt(1 - offset * offset);
            CHECK(moved.positions[0].x == Approx(-line + phase * 0.1f).epsilon(1e-4));
            CHECK(moved.positions[0].y == Approx(offset));
            CHECK(deepest(scene) == 0.0);
        }
}

TEST_CASE("a head-on collision of two bodies gives the speeds of the closed form") {
    const float ratio = 3.0f;
    const Scene scene = makeTwoBodies({.massRatio = ratio, .phase = 0.5f, .restitution = 0.5f});
    const Spheres end = afterOneStep(scene);
    const double v = scene.spheres.velocities[0].x;
    const truth::LineSpeeds speeds = truth::headOn(1, v, ratio, 0, 0.5);
    CHECK(end.velocities[0].x == Approx(speeds.first).epsilon(1e-5));
    CHECK(end.velocities[1].x == Approx(speeds.second).epsilon(1e-5));
}

TEST_CASE("all contacts of a hub and of a pocket come in the first step") {
    const auto contactsAfterOneStep = [](const Scene& scene) {
        PhysicsSimulator simulator(settingsFor(scene, Device::cpu));
        simulator.bodies().upload(scene.spheres);
        return simulator.step().collisions;
    };
    for (const int spokes : {1, 3, 12}) {
        CAPTURE(spokes);
        CHECK(contactsAfterOneStep(makeHub({.spokes = spokes})) == std::uint32_t(spokes));
    }
    CHECK(contactsAfterOneStep(makePocket(1.0f)) == 3);
}

TEST_CASE("reversing a cradle changes the numbers and not the places") {
    const Scene straight = makeCradle(5, false), reversed = makeCradle(5, true);
    for (std::size_t k = 0; k < 5; ++k) {
        CHECK(straight.spheres.positions[k] == reversed.spheres.positions[4 - k]);
        CHECK(straight.spheres.velocities[k] == reversed.spheres.velocities[4 - k]);
    }
}

TEST_CASE("no pathology loses a ball or makes one that is not finite") {
    for (const char* name : {"one_cell", "coincident", "outside", "far_from_origin"}) {
        CAPTURE(name);
        const Scene scene = makeScene(name, sceneKind(name).usualCount, 1);
        const Spheres end = test::simulate(scene, settingsFor(scene, Device::cpu), 20);
        const Losses losses = lossesOf(end, scene.bounds);
        CHECK(losses.lost == 0);
        CHECK(losses.notFinite == 0);
    }
}

TEST_CASE("an impulse too large for a float ends with the ball's number, and the state is kept") {
    const Scene scene = makeNotFinite();
    PhysicsSimulator simulator(settingsFor(scene, Device::cpu));
    simulator.bodies().upload(scene.spheres);
    const std::string message = test::messageOf<NotFiniteError>([&] { simulator.step(); });
    CHECK(test::contains(message, "body 0 is not finite"));
    CHECK(sameBits(simulator.bodies().download(), scene.spheres));
}

TEST_CASE("a pair list too small for one cell's balls grows, or says how much it needs") {
    const Scene scene = makeScene("one_cell", 200, 1);
    SimulatorSettings settings = settingsFor(scene, Device::cpu);
    settings.pairCapacity = 100;
    PhysicsSimulator growing(settings);
    growing.bodies().upload(scene.spheres);
    CHECK(growing.step().overflow > 0);
    settings.growPairs = false;
    PhysicsSimulator fixed(settings);
    fixed.bodies().upload(scene.spheres);
    const std::string message = test::messageOf<std::runtime_error>([&] { fixed.step(); });
    CHECK(test::contains(message, "pair list full"));
    CHECK(test::contains(message, "100 available"));
    CHECK(sameBits(fixed.bodies().download(), scene.spheres));
}
