// Falling and bouncing. Semi-implicit Euler has a closed form in free fall, errors of first order
// in dt, and conserves a shadow energy; the walls may only take energy away.
#include <cmath>

#include "tests/support.h"

using namespace ballpit;

namespace {

constexpr float gravity = 9.81f, radius = 0.5f;

/// One ball whose centre is `height` m above the floor of a world that is high enough for it.
Scene oneBall(float height, float restitution, float dt) {
    Scene scene = test::emptyWorld();
    scene.bounds = {{-10, 0, -10}, {10, 40, 10}};
    scene.gravity = {0, -gravity, 0};
    scene.dt = dt;
    scene.spheres.add({0.5f, height, -0.5f}, {0, 0, 0}, radius, 2.0f, restitution);
    return scene;
}

/// A simulator with the scene's bodies in it.
struct Running {
    Running(const Scene& scene, Device device)
        : scene(scene), simulator(test::settingsFor(scene, device)) {
        simulator.bodies().upload(scene.spheres);
    }
    Vec3 position() { return simulator.bodies().positions.download()[0]; }
    Metrics metrics() {
        return measure(simulator.bodies().download(), scene.bounds, scene.gravity, scene.dt);
    }

    Scene scene;
    PhysicsSimulator simulator;
};

/// The highest point after each of the first `count` bounces, m above the floor.
std::vector<double> bounceHeights(const Scene& scene, Device device, std::size_t count) {
    Running running(scene, device);
    std::vector<double> heights;
    double highest = 0.0;
    bool rising = false;
    for (double time = 0.0; heights.size() < count; time += scene.dt) {
        REQUIRE(time < 20.0);
        running.simulator.step();
        const bool risesNow = running.simulator.bodies().velocities.download()[0].y > 0.0f;
        if (rising && !risesNow) heights.push_back(highest);
        if (!rising) highest = 0.0;
        highest = std::max(highest, double(running.position().y));
        rising = risesNow;
    }
    return heights;
}

}  // namespace

TEST_CASE("free fall is the integrator's closed form") {
    const Device device = GENERATE(from_range(test::devices()));
    const float damping = GENERATE(0.0f, 0.5f);
    const float dt = GENERATE(1.0f / 60.0f, 1.0f / 240.0f);
    const int steps = GENERATE(1, 2, 60);
    CAPTURE(damping, dt, steps);
    Scene scene = oneBall(20.0f, 0.5f, dt);
    scene.damping = damping;
    const Vec3 start{1.5f, 2.0f, -0.75f};
    scene.spheres.velocities[0] = start;
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), steps);

    // Kick, damp, drift, in double precision: v <- d (v + g dt), x <- x + v dt.
    const double d = 1.0 - double(damping) * dt, h = dt, dn = std::pow(d, steps);
    const double sumOfPowers = damping == 0.0f ? steps : d * (1.0 - dn) / (1.0 - d);
    CHECK(end.velocities[0].y == Approx(dn * start.y - gravity * h * sumOfPowers).epsilon(1e-5));
    CHECK(end.velocities[0].x == Approx(dn * start.x).epsilon(1e-5));
    CHECK(end.velocities[0].z == Approx(dn * start.z).epsilon(1e-5));
    CHECK(end.positions[0].x == Approx(0.5 + h * start.x * sumOfPowers).epsilon(1e-5));
    if (damping == 0.0f) {
        const double n = steps;
        CHECK(end.positions[0].y ==
              Approx(20.0 + n * h * start.y - gravity * h * h * n * (n + 1) / 2).epsilon(1e-5));
    }
}

TEST_CASE("the error of a fall is of first order in dt") {
    const Device device = GENERATE(from_range(test::devices()));
    const auto errorAt = [&](int stepsPerSecond) {
        const Scene scene = oneBall(20.0f, 0.5f, 1.0f / static_cast<float>(stepsPerSecond));
        const Spheres end = test::simulate(scene, test::settingsFor(scene, device), stepsPerSecond);
        return std::abs(end.positions[0].y - (20.0 - 0.5 * gravity));
    };
    for (const int rate : {60, 120, 240, 480}) {
        CAPTURE(rate);
        CHECK(std::log2(errorAt(rate) / errorAt(2 * rate)) == Approx(1.0).margin(0.05));
    }
}

// A ball that crosses the floor is put back on it: up to one step of its motion is lost to it. Of a
// bounce of height h that is at most dt sqrt(2 g / h), and the losses of all bounces add up: 3.5 %
// for the first bounce to 5 m at 60 Hz, 0.2 % at 1 kHz.
TEST_CASE("a ball bounces to e^2 of its height, less a loss that shrinks with dt") {
    const Device device = GENERATE(from_range(test::devices()));
    const float restitution = GENERATE(0.3f, 0.5f, 0.8f, 0.95f, 1.0f);
    const int rate = GENERATE(60, 240, 1000);
    CAPTURE(restitution, rate);
    const Scene scene = oneBall(5.0f + radius, restitution, 1.0f / static_cast<float>(rate));
    double ideal = 5.0, loss = 0.0;
    for (const double height : bounceHeights(scene, device, 2)) {
        ideal *= double(restitution) * restitution;
        loss += 1.5 / rate * std::sqrt(gravity / ideal);
        CAPTURE(ideal, loss);
        CHECK(height - radius < ideal * (1.0 + 1e-5));
        CHECK(height - radius > ideal * (1.0 - loss));
    }
}

TEST_CASE("a ball without restitution stays on the floor") {
    const Device device = GENERATE(from_range(test::devices()));
    Running running(oneBall(3.0f, 0.0f, 1.0f / 60.0f), device);
    for (int k = 0; k < 120; ++k) running.simulator.step();
    for (int k = 0; k < 120; ++k) {
        running.simulator.step();
        REQUIRE(running.position() == Vec3{0.5f, radius, -0.5f});
    }
    CHECK(running.metrics().kineticEnergy == 0.0);
}

// With v the speed at the floor, a bounce changes the shadow energy by at most
// m (1 - e) v (g dt - (1 + e) v) / 2. That is a loss, but for a ball that all but rests (v < g dt):
// there it is a gain of at most m (g dt)^2 / 8, taken back in the next step.
TEST_CASE("the shadow energy of one ball is constant in flight and never grows in a bounce") {
    const Device device = GENERATE(from_range(test::devices()));
    const float restitution = GENERATE(0.0f, 0.5f, 1.0f);
    const int rate = GENERATE(60, 1000);
    CAPTURE(restitution, rate);
    Running running(oneBall(6.0f, restitution, 1.0f / static_cast<float>(rate)), device);
    const double atFirst = running.metrics().shadowEnergy;
    const double mass = 2.0, kick = double(gravity) / rate, restingGain = mass * kick * kick / 8.0;
    double before = atFirst;
    bool bounced = false;
    for (int k = 0; k < 5 * rate; ++k) {
        running.simulator.step();
        const double now = running.metrics().shadowEnergy;
        const bool onFloor = running.position().y == radius;
        const bool rests = running.metrics().kineticEnergy < 0.5 * mass * kick * kick;
        if (!onFloor) REQUIRE(now == Approx(before).epsilon(1e-5));
        REQUIRE(now < before + (rests ? restingGain : 0.0) + 1e-6 * atFirst);
        bounced = bounced || onFloor;
        before = now;
    }
    CHECK(bounced);
    CHECK(before < atFirst * (1.0 + 1e-5));
}

TEST_CASE("200 falling balls never gain energy and never leave the world") {
    const Device device = GENERATE(from_range(test::devices()));
    const std::uint64_t seed = GENERATE(1, 2, 3);
    CAPTURE(seed);
    Scene scene = makeGravityFall(200, seed);
    scene.damping = 0.0f;
    Running running(scene, device);
    const double atFirst = running.metrics().shadowEnergy;
    double before = atFirst;
    std::uint32_t collisions = 0;
    for (int k = 0; k < 600; ++k) {
        collisions += running.simulator.step().collisions;
        const Metrics now = running.metrics();
        REQUIRE(now.lost == 0);
        REQUIRE(now.notFinite == 0);
        REQUIRE(now.shadowEnergy < before + 2e-7 * atFirst);
        before = now.shadowEnergy;
    }
    CHECK(collisions > 500);
    CHECK(before < 0.2 * atFirst);
}

TEST_CASE("each of the six walls holds a ball back") {
    const Device device = GENERATE(from_range(test::devices()));
    const Vec3 direction = GENERATE(Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0},
                                    Vec3{0, 0, 1}, Vec3{0, 0, -1});
    CAPTURE(direction);
    Scene scene = test::emptyWorld();
    const Vec3 tangential = 0.25f * Vec3{direction.y, direction.z, direction.x};
    scene.spheres.add(8.0f * direction, 60.0f * direction + tangential, radius, 1.0f, 0.5f);
    const Spheres atWall = test::simulate(scene, test::settingsFor(scene, device), 2);
    CHECK(dot(atWall.positions[0], direction) == 10.0f - radius);
    CHECK(dot(atWall.velocities[0], direction) == -30.0f);
    CHECK(dot(atWall.velocities[0], tangential) == dot(tangential, tangential));
}

TEST_CASE("a ball beyond a wall that already comes back keeps its velocity") {
    const Device device = GENERATE(from_range(test::devices()));
    const Vec3 direction = GENERATE(Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0},
                                    Vec3{0, 0, 1}, Vec3{0, 0, -1});
    CAPTURE(direction);
    Scene scene = test::emptyWorld();
    scene.spheres.add(12.0f * direction, -3.0f * direction, radius, 1.0f, 0.5f);
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), 1);
    CHECK(end.positions[0] == (10.0f - radius) * direction);
    CHECK(end.velocities[0] == -3.0f * direction);
}
