// Two balls meet. What becomes of them has a closed form: with n the contact normal from a to b,
// v_n the speed of approach and m_eff = 1 / (1/m_a + 1/m_b),
//     J = (1 + e) m_eff v_n,   v_a' = v_a - J/m_a n,   v_b' = v_b + J/m_b n.
#include <cmath>

#include "tests/support.h"

using namespace ballpit;

namespace {

Vec3d widen(Vec3 v) { return {v.x, v.y, v.z}; }
Vec3d along(Vec3d start, double s, Vec3d direction) {
    return {start.x + s * direction.x, start.y + s * direction.y, start.z + s * direction.z};
}
double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3d difference(Vec3d a, Vec3d b) { return along(a, -1.0, b); }

/// Two balls about to collide half-way through the first step. They approach along `direction` at
/// `speed`, of which ball a brings the share `shareOfA` and ball b the rest.
Scene aboutToCollide(Vec3 direction, float speed, float shareOfA) {
    Scene scene = test::emptyWorld();
    const float radiusA = 0.5f, radiusB = 0.75f;
    const float distance = radiusA + radiusB + 0.5f * speed * scene.dt;
    const Vec3 a{0.3f, -0.2f, 0.1f};
    scene.spheres.add(a, shareOfA * speed * direction, radiusA, 1.0f, 1.0f);
    scene.spheres.add(a + distance * direction, (shareOfA - 1.0f) * speed * direction, radiusB,
                      1.0f, 1.0f);
    return scene;
}

/// The contact normal at the end of the first step's motion.
Vec3d normalAtContact(const Scene& scene) {
    const auto moved = [&](std::size_t k) {
        return along(widen(scene.spheres.positions[k]), scene.dt,
                     widen(scene.spheres.velocities[k]));
    };
    const Vec3d offset = difference(moved(1), moved(0));
    return along({}, 1.0 / length(offset), offset);
}

struct Expected {
    Vec3d velocityA, velocityB;
    double approachSpeed, energyChange;
};

Expected closedForm(const Scene& scene) {
    const Spheres& s = scene.spheres;
    const Vec3d a = widen(s.velocities[0]), b = widen(s.velocities[1]);
    const Vec3d normal = normalAtContact(scene);
    const double approach = dot(difference(a, b), normal);
    const double e = std::min(s.restitutions[0], s.restitutions[1]);
    const double effectiveMass = 1.0 / (1.0 / s.masses[0] + 1.0 / s.masses[1]);
    const double impulse = (1.0 + e) * effectiveMass * approach;
    return {along(a, -impulse / s.masses[0], normal), along(b, impulse / s.masses[1], normal),
            approach, -0.5 * effectiveMass * (1.0 - e * e) * approach * approach};
}

/// Runs past the collision and compares everything with the closed form.
void requireClosedForm(const Scene& scene, const SimulatorSettings& settings) {
    const Expected expected = closedForm(scene);
    const Metrics before = measure(scene.spheres, scene.bounds, scene.gravity, scene.dt);
    const Spheres end = test::simulate(scene, settings, 4);
    const Metrics after = measure(end, scene.bounds, scene.gravity, scene.dt);

    const double speeds =
        length(widen(scene.spheres.velocities[0])) + length(widen(scene.spheres.velocities[1]));
    REQUIRE(expected.approachSpeed > 0.0);
    CHECK(length(difference(widen(end.velocities[0]), expected.velocityA)) < 1e-6 * speeds);
    CHECK(length(difference(widen(end.velocities[1]), expected.velocityB)) < 1e-6 * speeds);

    const double momenta = scene.spheres.masses[0] * length(widen(scene.spheres.velocities[0])) +
                           scene.spheres.masses[1] * length(widen(scene.spheres.velocities[1]));
    CHECK(length(difference(after.momentum, before.momentum)) < 1e-6 * momenta);
    CHECK(std::abs(after.kineticEnergy - before.kineticEnergy - expected.energyChange) <
          1e-6 * before.kineticEnergy);
    CHECK(after.largestPenetration < 1e-6);
}

}  // namespace

TEST_CASE("a head-on collision gives the closed form's velocities, momentum and energy") {
    const Device device = GENERATE(from_range(test::devices()));
    const float massA = GENERATE(1.0f, 1000.0f), massB = GENERATE(1.0f, 3.0f, 1000.0f);
    const float restitution = GENERATE(0.0f, 0.5f, 1.0f);
    const float speed = GENERATE(0.1f, 1.0f, 10.0f);
    const float shareOfA = GENERATE(0.0f, 0.5f, 1.0f);
    CAPTURE(massA, massB, restitution, speed, shareOfA);
    Scene scene = aboutToCollide({1, 0, 0}, speed, shareOfA);
    scene.spheres.masses = {massA, massB};
    scene.spheres.restitutions = {restitution, restitution};
    requireClosedForm(scene, test::settingsFor(scene, device));
}

TEST_CASE("one round a step resolves a collision of two balls as well as two rounds") {
    const Device device = GENERATE(from_range(test::devices()));
    const int iterations = GENERATE(1, 2, 3);
    CAPTURE(iterations);
    Scene scene = aboutToCollide({0, 1, 0}, 2.0f, 0.25f);
    scene.spheres.masses = {2.0f, 5.0f};
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.iterations = iterations;
    requireClosedForm(scene, settings);
}

TEST_CASE("an oblique collision leaves the tangential velocities as they were") {
    const Device device = GENERATE(from_range(test::devices()));
    const float restitution = GENERATE(0.0f, 0.5f, 1.0f);
    const Vec3 sideways = GENERATE(Vec3{0, 3, 0}, Vec3{0, -1, 2});
    CAPTURE(restitution, sideways);
    Scene scene = aboutToCollide({0.6f, 0, 0.8f}, 4.0f, 0.5f);
    scene.spheres.velocities[0] += sideways;
    scene.spheres.velocities[1] -= 0.5f * sideways;
    scene.spheres.masses = {1.0f, 3.0f};
    scene.spheres.restitutions = {restitution, restitution};
    requireClosedForm(scene, test::settingsFor(scene, device));

    const Vec3d normal = normalAtContact(scene);
    const auto tangential = [&](Vec3 v) { return along(widen(v), -dot(widen(v), normal), normal); };
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), 4);
    for (const std::size_t k : {0u, 1u}) {
        const Vec3d before = tangential(scene.spheres.velocities[k]);
        CHECK(length(difference(tangential(end.velocities[k]), before)) < 5e-6);
    }
}

TEST_CASE("of two different restitutions the smaller decides") {
    const Device device = GENERATE(from_range(test::devices()));
    const bool dullFirst = GENERATE(false, true);
    Scene scene = aboutToCollide({1, 0, 0}, 2.0f, 0.5f);
    scene.spheres.restitutions = {dullFirst ? 0.25f : 0.75f, dullFirst ? 0.75f : 0.25f};
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), 4);
    CHECK(end.velocities[1].x - end.velocities[0].x == Approx(0.25 * 2.0).epsilon(1e-6));
}

TEST_CASE("overlapping balls that already separate keep their velocities to the last bit") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld();
    scene.spheres.add({-0.3f, 0.1f, 0}, {-1.1f, 0.7f, 0.3f}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({0.3f, -0.1f, 0}, {0.9f, -0.6f, 0.2f}, 0.5f, 3.0f, 1.0f);
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), 3);
    CHECK(test::bitsOf(end.velocities) == test::bitsOf(scene.spheres.velocities));
    CHECK(measure(end, scene.bounds, {}, scene.dt).largestPenetration < 1e-6);
}

TEST_CASE("which ball has which number does not change a bit of the collision") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = aboutToCollide({0.6f, 0.48f, 0.64f}, 5.0f, 0.3f);
    scene.spheres.masses = {1.0f, 7.0f};
    scene.spheres.restitutions = {0.7f, 0.8f};
    Scene swapped = scene;
    swapped.spheres = {};
    for (const std::size_t k : {1u, 0u})
        swapped.spheres.add(scene.spheres.positions[k], scene.spheres.velocities[k],
                            scene.spheres.radii[k], scene.spheres.masses[k],
                            scene.spheres.restitutions[k]);
    const SimulatorSettings settings = test::settingsFor(scene, device);
    const Spheres end = test::simulate(scene, settings, 4);
    Spheres other = test::simulate(swapped, settings, 4);
    std::swap(other.positions[0], other.positions[1]);
    std::swap(other.velocities[0], other.velocities[1]);
    CHECK(test::bitsOf(end.positions) == test::bitsOf(other.positions));
    CHECK(test::bitsOf(end.velocities) == test::bitsOf(other.velocities));
}

TEST_CASE("a mirrored collision is the mirror image of the collision") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = aboutToCollide({0.6f, 0.48f, 0.64f}, 5.0f, 0.3f);
    scene.spheres.masses = {1.0f, 7.0f};
    Scene mirrored = scene;
    for (Vec3& position : mirrored.spheres.positions) position = -position;
    for (Vec3& velocity : mirrored.spheres.velocities) velocity = -velocity;
    const SimulatorSettings settings = test::settingsFor(scene, device);
    const Spheres end = test::simulate(scene, settings, 4);
    const Spheres image = test::simulate(mirrored, settings, 4);
    for (const std::size_t k : {0u, 1u}) {
        CHECK(image.positions[k] == -end.positions[k]);
        CHECK(image.velocities[k] == -end.velocities[k]);
    }
}

TEST_CASE("balls at exactly the sum of their radii do not collide, a hair nearer they do") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld();
    scene.dt = 1.0f / 64.0f;
    // Powers of two, so that no step rounds: after one step the centres are exactly 1 m apart.
    scene.spheres.add({0, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({1.0f + scene.dt, 0, 0}, {-1, 0, 0}, 0.5f, 1.0f, 1.0f);
    const bool nearer = GENERATE(false, true);
    CAPTURE(nearer);
    if (nearer) scene.spheres.positions[1].x = std::nextafter(1.0f + scene.dt, 0.0f);
    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    CHECK(simulator.step().collisions == (nearer ? 1u : 0u));
    CHECK(simulator.bodies().velocities.download()[1].x == (nearer ? 0.0f : -1.0f));
    CHECK(spheresTouch({0, 0, 0, 0.5f}, {1, 0, 0, 0.5f}) == false);
}
