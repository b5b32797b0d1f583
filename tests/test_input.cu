// Settings and body values that a user can get wrong. Each mistake must be named (where, what, and
// what would be right), and nothing may have changed.
#include <cmath>
#include <limits>

#include "tests/command_line.h"
#include "tests/support.h"

using namespace ballpit;
using test::CommandLine;
using test::contains;
using test::runWith;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

std::string messageOfSettings(const SimulatorSettings& settings) {
    return test::messageOf<InputError>([&] { PhysicsSimulator simulator(settings); });
}

SimulatorSettings goodSettings() {
    SimulatorSettings settings;
    settings.device = Device::cpu;
    settings.objects = 2;
    return settings;
}

}  // namespace

TEST_CASE("each senseless setting is refused in words") {
    struct Case {
        const char* message;
        SimulatorSettings settings;
    };
    std::vector<Case> cases;
    const auto add = [&](const char* message, auto change) {
        cases.push_back({message, goodSettings()});
        change(cases.back().settings);
    };
    using S = SimulatorSettings;
    add("count 0: at least 1 ball", [](S& s) { s.objects = 0; });
    add("count -5: at least 1 ball", [](S& s) { s.objects = -5; });
    add("world: upper must lie above lower", [](S& s) { s.bounds.upper.x = -20; });
    add("world: upper must lie above lower", [](S& s) { s.bounds.upper.y = -1; });
    add("world: upper must lie above lower", [](S& s) { s.bounds.lower.z = notANumber; });
    add("must be above 0 m", [](S& s) { s.cellSize = 0; });
    add("cell size -1.0", [](S& s) { s.cellSize = -1; });
    add("must be above 0 m", [](S& s) { s.cellSize = notANumber; });
    add("dt 0.0", [](S& s) { s.dt = 0; });
    add("dt -0.1", [](S& s) { s.dt = -0.1f; });
    add("at most 1 s", [](S& s) { s.dt = 1.5f; });
    add("at most 1 s", [](S& s) { s.dt = notANumber; });
    add("gravity: must be a finite number", [](S& s) { s.gravity.y = infinity; });
    add("gravity: must be a finite number", [](S& s) { s.gravity.x = notANumber; });
    add("damping -0.1", [](S& s) { s.damping = -0.1f; });
    add("must lie between 0 and 1/dt", [](S& s) { s.damping = 61; });
    add("must lie between 0 and 1/dt", [](S& s) { s.damping = notANumber; });
    add("iterations 0: 1 to 1000", [](S& s) { s.iterations = 0; });
    add("iterations 1001: 1 to 1000", [](S& s) { s.iterations = 1001; });
    for (const Case& bad : cases) {
        const std::string message = messageOfSettings(bad.settings);
        CAPTURE(bad.message, message);
        CHECK(contains(message, bad.message));
    }
    CHECK(messageOfSettings(goodSettings()) == "(nothing was thrown)");
}

TEST_CASE("too many cells are refused with a cell size that is large enough") {
    SimulatorSettings settings = goodSettings();
    settings.cellSize = 0.001f;
    const std::string message = messageOfSettings(settings);
    CAPTURE(message);
    REQUIRE(contains(message, "at least "));
    const float enough = std::stof(message.substr(message.find("at least ") + 9));
    CHECK(enough < 0.05f);
    CHECK(UniformGrid::predictedBytes(settings.bounds, enough, 2) > 0);
}

TEST_CASE("more balls than memory are refused before any is made") {
    SimulatorSettings settings = goodSettings();
    settings.objects = 2000000000;
    const std::string message = messageOfSettings(settings);
    CAPTURE(message);
    CHECK(contains(message, "count 2000000000 needs "));
    CHECK(contains(message, "GiB"));
    CHECK(contains(message, "use fewer balls"));
}

TEST_CASE("a GPU that is not there is refused with what would help") {
    if (cudaUsable()) return;
    SimulatorSettings settings = goodSettings();
    settings.device = Device::cuda;
    CHECK(contains(messageOfSettings(settings), "use --device cpu"));
    const CommandLine line = runWith("--device cuda");
    CHECK(line.exitCode == exitBadInput);
    CHECK(contains(line.errors, "error: --device cuda: "));
}

TEST_CASE("a ball larger than a cell is refused with the size that would do") {
    const Device device = GENERATE(from_range(test::devices()));
    SimulatorSettings settings = goodSettings();
    settings.device = device;
    settings.cellSize = 1.0f;
    PhysicsSimulator simulator(settings);
    simulator.bodies().radii.upload({0.25f, 0.625f});
    const std::string message = test::messageOf<InputError>([&] { simulator.step(); });
    CAPTURE(message);
    CHECK(contains(message, "use at least 1.25"));

    settings.cellSize = 1.25f;
    PhysicsSimulator larger(settings);
    larger.bodies().radii.upload({0.25f, 0.625f});
    larger.step();
}

TEST_CASE("a ball larger than the world is refused") {
    const Device device = GENERATE(from_range(test::devices()));
    SimulatorSettings settings = goodSettings();
    settings.device = device;
    settings.bounds = {{0, 0, 0}, {10, 1, 10}};
    PhysicsSimulator simulator(settings);
    simulator.bodies().radii.upload({0.25f, 0.625f});
    CHECK(contains(test::messageOf<InputError>([&] { simulator.step(); }),
                   "a ball of diameter 1.25"));
}

TEST_CASE("an upload of the wrong count or of a bad value names it and changes nothing") {
    const Device device = GENERATE(from_range(test::devices()));
    RigidBodySystem bodies(device, 3);
    const Spheres before = bodies.download();
    const auto message = [](auto call) { return test::messageOf<InputError>(call); };
    const Vec3 good{1, 2, 3}, bad{1, notANumber, 3};
    CHECK(message([&] {
              bodies.positions.upload({good, good});
          }) == "positions: 2 values for 3 bodies");
    CHECK(message([&] { bodies.masses.upload({1, 2, 3, 4}); }) == "masses: 4 values for 3 bodies");
    CHECK(contains(message([&] {
                       bodies.positions.upload({good, bad, bad});
                   }),
                   "body 1: position (1, nan, 3)"));
    CHECK(contains(message([&] {
                       bodies.velocities.upload({good, good, bad});
                   }),
                   "body 2: velocity (1, nan, 3)"));
    CHECK(contains(message([&] { bodies.radii.upload({1, -1, 1}); }), "body 1: radius -1"));
    CHECK(contains(message([&] { bodies.masses.upload({0, 1, 1}); }), "body 0: mass 0"));
    CHECK(contains(message([&] { bodies.masses.upload({1, infinity, 1}); }), "body 1: mass inf"));
    CHECK(contains(message([&] {
                       bodies.restitutions.upload({1, 1, 1.5f});
                   }),
                   "body 2: restitution 1.5"));
    const Spheres after = bodies.download();
    CHECK(test::bitsOf(after.positions) == test::bitsOf(before.positions));
    CHECK(test::bitsOf(after.velocities) == test::bitsOf(before.velocities));
    CHECK(after.radii == before.radii);
    CHECK(after.masses == before.masses);
    CHECK(after.restitutions == before.restitutions);
    CHECK(bodies.largestRadius() == 0.0f);
}

TEST_CASE("an upload of all properties of which one is bad changes none") {
    const Device device = GENERATE(from_range(test::devices()));
    RigidBodySystem bodies(device, 2);
    Spheres spheres;
    spheres.add({1, 2, 3}, {4, 5, 6}, 0.5f, 1.0f, 0.5f);
    spheres.add({1, 2, 3}, {4, 5, 6}, 0.5f, 1.0f, 1.5f);
    CHECK_THROWS_AS(bodies.upload(spheres), InputError);
    CHECK(bodies.positions.download()[0] == Vec3{0, 0, 0});
    CHECK(bodies.radii.download()[0] == 0.0f);
    spheres.restitutions[1] = 0.5f;
    spheres.colors.pop_back();
    CHECK_THROWS_AS(bodies.upload(spheres), InputError);
}

TEST_CASE("a body that stops being finite is named with stage and step, and the state is kept") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld();
    scene.dt = 1.0f;
    scene.gravity = {0, -3e38f, 0};
    for (const float x : {5.0f, -5.0f, 0.0f}) scene.spheres.add({x, 0, 0}, {}, 0.5f, 1.0f, 1.0f);
    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    simulator.step();  // 3e38 m/s, turned round by the floor
    Spheres before = simulator.bodies().download();
    before.velocities[2] = before.velocities[1] = {0, -3e38f, 0};
    simulator.bodies().velocities.upload(before.velocities);
    // Slots are in order of x, so body 2 is not in slot 2: the smaller number is to be named.
    CHECK(test::messageOf<NotFiniteError>([&] { simulator.step(); }) ==
          "body 1 is not finite after integrate of step 1; the state before this step is kept");
    const Spheres after = simulator.bodies().download();
    CHECK(test::bitsOf(after.positions) == test::bitsOf(before.positions));
    CHECK(test::bitsOf(after.velocities) == test::bitsOf(before.velocities));

    simulator.bodies().velocities.upload(std::vector<Vec3>(3));
    simulator.step();  // and it can go on
}

TEST_CASE("a collision whose impulse overflows is named by its stage") {
    const Device device = GENERATE(from_range(test::devices()));
    const ResponseMethod response = GENERATE(ResponseMethod::massSplit, ResponseMethod::racy);
    Scene scene = test::emptyWorld();
    scene.dt = 1e-38f;  // 3 m at 3e38 m/s
    scene.spheres.add({5, 0, 0}, {}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({3.4f, 0, 0}, {-3e38f, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({-3.4f, 0, 0}, {3e38f, 0, 0}, 0.5f, 1.0f, 1.0f);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.response = response;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    CHECK(contains(test::messageOf<NotFiniteError>([&] { simulator.step(); }),
                   "body 1 is not finite after collisionResponse of step 0"));
    CHECK(stateHash(simulator.bodies().download()) == stateHash(scene.spheres));
}
