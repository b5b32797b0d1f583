// The whole pipeline without graphics, through the interface that a program uses.
#include <cmath>

#include "common/random.h"
#include "tests/support.h"

using namespace ballpit;

namespace {

/// A dense cloud of balls of mixed masses in the middle of a world too large to reach its walls.
Scene cloud(int count, float restitution, std::uint64_t seed) {
    Scene scene = test::emptyWorld(1.0f);
    scene.bounds = {{-40, -40, -40}, {40, 40, 40}};
    const float side = std::cbrt(static_cast<float>(count)) * 0.6f;
    Random random(seed);
    for (int k = 0; k < count; ++k) {
        const Vec3 position = random.uniformIn({{-side, -side, -side}, {side, side, side}});
        const Vec3 velocity = random.uniformIn({{-3, -3, -3}, {3, 3, 3}});
        const float radius = random.uniform(0.3f, 0.5f);
        scene.spheres.add(position, velocity, radius, random.uniform(0.5f, 5.0f), restitution);
    }
    return scene;
}

Metrics measureIn(const Scene& scene, const Spheres& spheres) {
    return measure(spheres, scene.bounds, scene.gravity, scene.dt);
}

Vec3d difference(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

void requireSameState(const Spheres& a, const Spheres& b) {
    CHECK(test::bitsOf(a.positions) == test::bitsOf(b.positions));
    CHECK(test::bitsOf(a.velocities) == test::bitsOf(b.velocities));
    CHECK(test::bitsOf(a.radii) == test::bitsOf(b.radii));
    CHECK(test::bitsOf(a.masses) == test::bitsOf(b.masses));
    CHECK(test::bitsOf(a.restitutions) == test::bitsOf(b.restitutions));
    CHECK(test::bitsOf(a.colors) == test::bitsOf(b.colors));
}

}  // namespace

TEST_CASE("a program uploads its bodies, steps, and downloads them") {
    const Device device = GENERATE(from_range(test::devices()));
    PhysicsSimulator simulator({.objects = 3,
                                .bounds = {{-20, 0, -20}, {20, 40, 20}},
                                .cellSize = 2.0f,
                                .device = device,
                                .dt = 1 / 60.f,
                                .gravity = {0, -9.81f, 0},
                                .damping = 0.01f});
    simulator.bodies().positions.upload({{0, 10, 0}, {0, 10.9f, 0}, {5, 20, 5}});
    simulator.bodies().velocities.upload({{0, 1, 0}, {0, -1, 0}, {0, 0, 0}});
    simulator.bodies().radii.upload({0.5f, 0.5f, 0.9f});
    simulator.bodies().masses.upload({1.0f, 2.0f, 3.0f});
    simulator.bodies().restitutions.upload({0.5f, 0.5f, 0.5f});
    simulator.bodies().colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

    const StepStats stats = simulator.step();
    CHECK(stats.collisions == 1);
    CHECK(stats.outside == 0);
    CHECK(stats.overflow == 0);
    CHECK(stats.frameTimeMs > 0.0);
    CHECK(stats.stages.empty());
    const std::vector<Vec3> velocities = simulator.bodies().velocities.download();
    CHECK(velocities[0].y < 0.0f);
    CHECK(velocities[1].y > velocities[0].y);
    CHECK(velocities[2].y == Approx(-9.81 / 60 * (1 - 0.01 / 60)).epsilon(1e-6));
    CHECK(simulator.bodies().colors[2] == Vec3{0, 0, 1});
}

TEST_CASE("bodies come back as they went up, before any step and after the sort moved them") {
    const Device device = GENERATE(from_range(test::devices()));
    const int steps = GENERATE(0, 1, 2, 3, 50);
    CAPTURE(steps);
    // Odd masses: 1 / (1 / m) does not give them back.
    Scene scene = cloud(300, 0.5f, 1);
    for (std::size_t k = 0; k < 300; ++k) {
        scene.spheres.restitutions[k] = static_cast<float>(k) / 300.0f;
        scene.spheres.colors[k] = {static_cast<float>(k) / 300.0f, 0, 1};
    }
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), steps);
    Spheres expected = scene.spheres;
    if (steps > 0) expected.positions = end.positions, expected.velocities = end.velocities;
    requireSameState(end, expected);
}

TEST_CASE("an upload between steps changes that property of each body and no other") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = cloud(200, 0.5f, 2);
    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    for (int k = 0; k < 3; ++k) simulator.step();
    Spheres expected = simulator.bodies().download();

    Random random(3);
    for (float& mass : expected.masses) mass = random.uniform(1.0f, 2.0f);
    simulator.bodies().masses.upload(expected.masses);
    requireSameState(simulator.bodies().download(), expected);
    for (Vec3& velocity : expected.velocities) velocity = random.uniformIn(scene.bounds);
    simulator.bodies().velocities.upload(expected.velocities);
    requireSameState(simulator.bodies().download(), expected);
    for (float& radius : expected.radii) radius = random.uniform(0.1f, 0.4f);
    simulator.bodies().radii.upload(expected.radii);
    requireSameState(simulator.bodies().download(), expected);
    CHECK(simulator.bodies().largestRadius() ==
          *std::max_element(expected.radii.begin(), expected.radii.end()));
}

TEST_CASE("the order in which properties are uploaded does not matter") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = cloud(200, 0.5f, 11);
    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().restitutions.upload(scene.spheres.restitutions);
    simulator.bodies().masses.upload(scene.spheres.masses);
    simulator.bodies().radii.upload(scene.spheres.radii);
    simulator.bodies().velocities.upload(scene.spheres.velocities);
    simulator.bodies().positions.upload(scene.spheres.positions);
    simulator.bodies().colors = scene.spheres.colors;
    requireSameState(simulator.bodies().download(), scene.spheres);
    for (int k = 0; k < 20; ++k) simulator.step();
    requireSameState(simulator.bodies().download(),
                     test::simulate(scene, test::settingsFor(scene, device), 20));
}

TEST_CASE("each body keeps its number: numbering them otherwise gives the same motion") {
    const Device device = GENERATE(from_range(test::devices()));
    // Too far apart to meet, so that not even the order of summation can differ.
    Scene scene = test::emptyWorld();
    for (int k = 0; k < 8; ++k) {
        const float at = static_cast<float>(k % 2) * 8 - 4, up = static_cast<float>(k / 2) * 4 - 6;
        scene.spheres.add({at, up, -at}, {0.1f * up, 0.2f * at, 1}, 0.5f, 1.0f, 0.5f);
    }
    Scene backwards = scene;
    std::reverse(backwards.spheres.positions.begin(), backwards.spheres.positions.end());
    std::reverse(backwards.spheres.velocities.begin(), backwards.spheres.velocities.end());
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), 60);
    Spheres other = test::simulate(backwards, test::settingsFor(scene, device), 60);
    std::reverse(other.positions.begin(), other.positions.end());
    std::reverse(other.velocities.begin(), other.velocities.end());
    requireSameState(end, other);
}

TEST_CASE("a dense gas keeps its momentum and never gains kinetic energy") {
    const Device device = GENERATE(from_range(test::devices()));
    const float restitution = GENERATE(0.0f, 0.5f, 1.0f);
    const std::uint64_t seed = GENERATE(1, 2, 3);
    CAPTURE(restitution, seed);
    const Scene scene = cloud(400, restitution, seed);
    const Metrics atFirst = measureIn(scene, scene.spheres);
    double mass = 0.0;
    for (const float m : scene.spheres.masses) mass += m;
    const double scale = std::sqrt(2.0 * atFirst.kineticEnergy * mass);

    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    double energy = atFirst.kineticEnergy;
    std::uint32_t collisions = 0;
    for (int k = 0; k < 200; ++k) {
        collisions += simulator.step().collisions;
        const Metrics now = measureIn(scene, simulator.bodies().download());
        REQUIRE(now.kineticEnergy < energy * (1.0 + 1e-6));
        REQUIRE(length(difference(now.momentum, atFirst.momentum)) < 1e-5 * scale);
        REQUIRE(now.notFinite == 0);
        energy = now.kineticEnergy;
    }
    CHECK(collisions > 1000);
    CHECK(energy < 0.99 * atFirst.kineticEnergy);
}

TEST_CASE("an elastic ball dropped into a pocket of three gains no energy") {
    const Device device = GENERATE(from_range(test::devices()));
    const int iterations = GENERATE(1, 2);
    CAPTURE(iterations);
    Scene scene = test::emptyWorld();
    scene.dt = 1.0f / 64.0f;
    // Three balls in a triangle, clear of each other; the fourth comes down on all of them.
    for (int k = 0; k < 3; ++k) {
        const float angle = 2.0943951f * static_cast<float>(k);
        scene.spheres.add({0.6f * std::cos(angle), 0, 0.6f * std::sin(angle)}, {}, 0.5f, 1.0f,
                          1.0f);
    }
    scene.spheres.add({0, 0.85f, 0}, {0, -4, 0}, 0.5f, 1.0f, 1.0f);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.iterations = iterations;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    REQUIRE(simulator.step().collisions == 3);
    const Metrics before = measureIn(scene, scene.spheres);
    const Metrics after = measureIn(scene, simulator.bodies().download());
    CHECK(after.kineticEnergy < before.kineticEnergy * (1.0 + 1e-6));
    CHECK(length(difference(after.momentum, before.momentum)) < 1e-5 * length(before.momentum));
    CHECK(after.momentum.y == Approx(-4.0).epsilon(1e-5));
    CHECK(simulator.bodies().velocities.download()[0].y < -0.5f);
}

TEST_CASE("a rehearsed step changes nothing, and the step after it is the same as without") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = makePile(500, 4);
    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    simulator.step();
    const Spheres before = simulator.bodies().download();
    CHECK(simulator.rehearseStep().collisions > 500);
    simulator.rehearseStep();
    requireSameState(simulator.bodies().download(), before);
    simulator.step();
    requireSameState(simulator.bodies().download(),
                     test::simulate(scene, test::settingsFor(scene, device), 2));
}

TEST_CASE("timeStages gives every stage a name and a time, and changes no result") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = makeUniform(2000, 5);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.timeStages = true;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    for (int k = 0; k < 3; ++k) {
        const StepStats stats = simulator.step();
        std::vector<std::string> names;
        double sum = 0.0;
        for (const StageTime& stage : stats.stages) {
            CHECK(stage.milliseconds > 0.0);
            names.push_back(stage.stage);
            sum += stage.milliseconds;
        }
        CHECK(names == std::vector<std::string>{"integrate + hash", "sort", "reorder + cell bounds",
                                                "broad phase", "response"});
        CHECK(sum < stats.frameTimeMs);
    }
    settings.timeStages = false;
    CHECK(stateHash(simulator.bodies().download()) ==
          stateHash(test::simulate(scene, settings, 3)));
}

TEST_CASE("the stages called one by one make the same step") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = makeUniform(500, 6);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.iterations = 1;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    simulator.step();

    // Of the three copies of the bodies one holds the state; the two others take turns.
    const RigidBodySystem::Copies state = simulator.bodies().state();
    const std::size_t oneMoving = (state.moving + 1) % 3, otherMoving = (state.moving + 2) % 3;
    const RigidBodySystem::Copies moved{oneMoving, state.fixed},
        sorted{otherMoving, (state.fixed + 1) % 3}, resolved{oneMoving, sorted.fixed};
    simulator.integrate(state, moved);
    simulator.buildGrid(moved, sorted);
    simulator.detectCollisions(sorted);
    simulator.resolveCollisions(sorted, resolved, 1.0f);
    simulator.bodies().commit(resolved);
    requireSameState(simulator.bodies().download(), test::simulate(scene, settings, 2));
}

TEST_CASE("the racy response conserves momentum and energy where only two balls meet") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld();
    scene.spheres.add({-0.51f, 0, 0}, {2, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({0.51f, 0, 0}, {-1, 0, 0}, 0.5f, 3.0f, 1.0f);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.response = ResponseMethod::racy;
    const Spheres end = test::simulate(scene, settings, 3);
    // Elastic: v = 2 * (centre of mass velocity -0.25) - v.
    CHECK(end.velocities[0].x == Approx(-2.5).epsilon(1e-6));
    CHECK(end.velocities[1].x == Approx(0.5).epsilon(1e-6));
    CHECK(measureIn(scene, end).largestPenetration < 1e-6);
}

TEST_CASE("balls with one centre and different velocities never become NaN") {
    const Device device = GENERATE(from_range(test::devices()));
    const int count = GENERATE(2, 3, 20);
    const ResponseMethod response = GENERATE(ResponseMethod::massSplit, ResponseMethod::racy);
    CAPTURE(count, static_cast<int>(response));
    Scene scene = test::emptyWorld();
    scene.dt = 1.0f / 64.0f;
    Random random(7);
    for (int k = 0; k < count; ++k) {
        const Vec3 velocity = random.uniformIn({{-9, -9, -9}, {9, 9, 9}});
        scene.spheres.add(-scene.dt * velocity, velocity, 0.5f, 1.0f, 1.0f);  // they meet at 0
    }
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.response = response;
    for (const int steps : {1, 2, 100}) {
        const Metrics metrics = measureIn(scene, test::simulate(scene, settings, steps));
        CHECK(metrics.notFinite == 0);
        if (response == ResponseMethod::massSplit) CHECK(metrics.lost == 0);
    }
}

TEST_CASE("any number of rounds a step works, and nobody is lost") {
    const Device device = GENERATE(from_range(test::devices()));
    const int iterations = GENERATE(1, 2, 3, 8);
    const std::string name = GENERATE("gravity_fall", "uniform", "gas", "pile");
    CAPTURE(iterations, name);
    const Scene scene = makeScene(name, 300, 8);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.iterations = iterations;
    const Metrics metrics = measureIn(scene, test::simulate(scene, settings, 120));
    CHECK(metrics.lost == 0);
    CHECK(metrics.notFinite == 0);
}

TEST_CASE("more rounds a step leave less penetration in a pile") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = makePile(216, 9);
    SimulatorSettings settings = test::settingsFor(scene, device);
    double before = 1.0;
    for (const int iterations : {1, 3, 9}) {
        settings.iterations = iterations;
        const double now = measureIn(scene, test::simulate(scene, settings, 60)).meanPenetration;
        CHECK(now < before);
        before = now;
    }
}
