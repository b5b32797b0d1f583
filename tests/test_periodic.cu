// A box without walls: pairs meet across its faces, nothing is lost, and the bits are the same.
#include "common/host_pairs.h"
#include "common/options.h"
#include "common/random.h"
#include "common/with_threads.h"
#include "stability/metrics.h"
#include "stability/scenes.h"
#include "tests/response_scenes.h"

using namespace ballpit;

namespace {

/// The responses that a periodic box can have, but for the race, which is never the same twice.
std::vector<ResponseMethod> methods() {
    using enum ResponseMethod;
    return {massSplit, atomic, jacobi, coloured};
}

Scene boxOf(Vec3 edges, float cellSize = 1.25f) {
    Scene scene = test::emptyWorld(cellSize);
    constexpr Vec3 lower{-1, 2, 0};
    scene.bounds = {lower, lower + edges};
    scene.periodic = true;
    return scene;
}
Scene boxOf(float edge) { return boxOf({edge, edge, edge}); }

/// Balls of 0.2 to 0.5 m at random, every third one on a face, an edge or a corner.
Scene crowdedBox(int count, Vec3 edges, float cellSize) {
    Scene scene = boxOf(edges, cellSize);
    Random random(static_cast<std::uint64_t>(count));
    for (int k = 0; k < count; ++k) {
        Vec3 place = random.uniformIn(scene.bounds);
        if (k % 3 == 0) place.x = k % 2 == 0 ? scene.bounds.lower.x : scene.bounds.upper.x;
        if (k % 6 == 0) place.y = k % 4 == 0 ? scene.bounds.lower.y : scene.bounds.upper.y;
        if (k % 12 == 0) place.z = scene.bounds.upper.z;
        scene.spheres.add(place, {}, random.uniform(0.2f, 0.5f), 1.0f, 1.0f);
    }
    return scene;
}
Scene crowdedBox(int count, float edge, float cellSize) {
    return crowdedBox(count, Vec3{edge, edge, edge}, cellSize);
}

/// The distance to the nearest of the 27 images of b, by looking at all of them.
double nearestDistance(Vec3 a, Vec3 b, Vec3 edge) {
    double nearest = 1e30;
    for (const int x : {-1, 0, 1})
        for (const int y : {-1, 0, 1})
            for (const int z : {-1, 0, 1}) {
                const double dx = double(b.x) + x * double(edge.x) - a.x,
                             dy = double(b.y) + y * double(edge.y) - a.y,
                             dz = double(b.z) + z * double(edge.z) - a.z;
                nearest = std::min(nearest, std::sqrt(dx * dx + dy * dy + dz * dz));
            }
    return nearest;
}

std::vector<Pair> bruteForceInBox(const Scene& scene) {
    const Spheres& s = scene.spheres;
    std::vector<Pair> pairs;
    for (std::uint32_t a = 0; a < s.count(); ++a)
        for (std::uint32_t b = a + 1; b < s.count(); ++b)
            if (nearestDistance(s.positions[a], s.positions[b], extent(scene.bounds)) <
                double(s.radii[a]) + s.radii[b])
                pairs.push_back({a, b});
    return pairs;
}

/// The pairs that the engine lists when nothing has moved yet, by body.
std::vector<Pair> pairsInBox(const Scene& scene, Device device) {
    SimulatorSettings settings = settingsFor(scene, device);
    settings.iterations = 1;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    simulator.step();
    return simulator.lastPairs();
}

Scene periodicGas(float share) {
    return stability::makeGasOf({.volumeShare = share, .travel = 0.1f, .periodic = true});
}

Spheres gasAfter(const Scene& scene, Device device, ResponseMethod method, int steps) {
    return test::simulate(scene, test::settingsFor(scene, device, method), steps);
}

std::string refusalOf(const Scene& scene, ResponseMethod method = ResponseMethod::coloured) {
    return test::messageOf<InputError>(
        [&] { PhysicsSimulator(test::settingsFor(scene, Device::cpu, method)); });
}

}  // namespace

TEST_CASE("a periodic box lists the pairs of brute force with nearest images", "[stability]") {
    const int count = GENERATE(1, 2, 33, 343);
    const float edge = GENERATE(3.76f, 4.9f, 8.0f);  // 3 cells, 3 and a long one, 6
    CAPTURE(count, edge);
    const Scene scene = crowdedBox(count, edge, 1.25f);
    const std::vector<Pair> expected = bruteForceInBox(scene);
    if (count > 2) REQUIRE(expected != test::bruteForcePairs(scene.spheres));
    for (const Device device : test::devices()) CHECK(pairsInBox(scene, device) == expected);
    CHECK(findPairsOnHost(scene.spheres, scene.bounds) == expected);
}

TEST_CASE("a periodic box whose edges differ lists all pairs", "[stability]") {
    // Each edge is once the shortest; the others then are not, by more than a cell.
    const Vec3 edges =
        GENERATE(Vec3{5.2f, 7.3f, 3.1f}, Vec3{3.1f, 5.2f, 7.3f}, Vec3{7.3f, 3.1f, 5.2f});
    CAPTURE(edges);
    const Scene scene = crowdedBox(150, edges, 1.0f);
    const std::vector<Pair> expected = bruteForceInBox(scene);
    for (const Device device : test::devices()) CHECK(pairsInBox(scene, device) == expected);
}

TEST_CASE("balls that touch across a face, an edge or a corner count as one contact",
          "[stability]") {
    Scene scene = boxOf(8.0f);
    const Vec3 lower = scene.bounds.lower;
    const Vec3 across =
        GENERATE(Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 1, 0}, Vec3{1, 1, 1});
    const Vec3 inner = lower + Vec3{0.2f, 0.2f, 0.2f};
    scene.spheres.add(inner, {}, 0.5f, 1, 1);
    scene.spheres.add(inner + 7.6f * across, {}, 0.5f, 1, 1);
    CAPTURE(across);
    const double distance = 0.4 * length(across);
    CHECK(findPairsOnHost(scene.spheres, scene.bounds).size() == 1);
    const stability::Overlap overlap =
        stability::overlapOf(scene.spheres, scene.bounds, scene.periodic);
    CHECK(overlap.contacts == 1);
    CHECK(overlap.wallContacts == 0);
    CHECK(overlap.max == Approx((1 - distance) / 0.5).epsilon(1e-5));
}

TEST_CASE("elastic balls that meet head-on across a face exchange their velocities",
          "[stability]") {
    const float speed = GENERATE(0.1f, 1.0f, 10.0f);
    CAPTURE(speed);
    Scene scene = boxOf(8.0f);
    const Vec3 lower = scene.bounds.lower;
    scene.spheres.add(lower + Vec3{0.6f, 4, 4}, {-speed, 0, 0}, 0.5f, 1, 1);
    scene.spheres.add(lower + Vec3{7.4f, 4, 4}, {speed, 0, 0}, 0.5f, 1, 1);
    scene.dt = 0.05f / speed;
    for (const ResponseMethod method : methods()) {
        CAPTURE(name(method));
        const Spheres end = gasAfter(scene, Device::cpu, method, 8);
        CHECK(std::abs(end.velocities[0].x - speed) < 1e-5f * speed);
        CHECK(std::abs(end.velocities[1].x + speed) < 1e-5f * speed);
    }
}

TEST_CASE("what leaves a periodic box comes in on the other side, however far it went",
          "[stability]") {
    Scene scene = boxOf(8.0f);
    const Vec3 lower = scene.bounds.lower;
    scene.spheres.add(lower + Vec3{7.5f, 1, 1}, {60, 0, 0}, 0.5f, 1, 1);
    scene.spheres.add(lower + Vec3{1, 0, 5}, {0, -60 * 8.25f, 0}, 0.5f, 1, 1);
    const Spheres end = gasAfter(scene, Device::cpu, ResponseMethod::coloured, 1);
    CHECK(end.positions[0].x == Approx(lower.x + 0.5f));
    CHECK(end.positions[1].y == Approx(lower.y + 7.75f));
    CHECK(end.velocities[0] == scene.spheres.velocities[0]);
}

TEST_CASE("a gas in a periodic box keeps its momentum and all its balls", "[stability]") {
    const Scene scene = periodicGas(0.3f);
    for (const ResponseMethod method : methods()) {
        CAPTURE(name(method));
        const Spheres end = gasAfter(scene, Device::cpu, method, 100);
        // A few roundings of 2^-24 a collision, in all directions.
        CHECK(stability::momentumError(scene.spheres, end) < 1e-6);
        const stability::Losses losses = stability::lossesOf(end, scene.bounds);
        CHECK(losses.lost == 0);
        CHECK(losses.notFinite == 0);
    }
}

TEST_CASE("a periodic box gives the same bits on any device, with any threads, in any order",
          "[stability]") {
    using enum ResponseMethod;
    // Loops over fewer than serialCount bodies are not shared by threads.
    const Scene scene = stability::makeGasOf({.count = serialCount + 100,
                                              .volumeShare = 0.3f,
                                              .travel = 0.1f,
                                              .restitution = 0.9f,
                                              .periodic = true});
    for (const ResponseMethod method : {massSplit, jacobi, coloured}) {
        CAPTURE(name(method));
        const auto hashOn = [&](Device device) {
            return hashText(stateHash(gasAfter(scene, device, method, 20)));
        };
        const std::string expected = hashOn(Device::cpu);
        {
            const WithThreads one(1);
            CHECK(hashOn(Device::cpu) == expected);
            const WithThreads two(2);
            CHECK(hashOn(Device::cpu) == expected);
        }
        for (const LaunchOrder order : {LaunchOrder::reversed, LaunchOrder::shuffled}) {
            const test::InOrder turned(order);
            CHECK(hashOn(Device::cpu) == expected);
        }
        for (const Device device : test::devices()) CHECK(hashOn(device) == expected);
    }
}

TEST_CASE("far from its faces a periodic box is a world like any other, to the last bit",
          "[stability]") {
    Scene scene = periodicGas(0.4f);
    scene.bounds.lower = scene.bounds.lower - Vec3{5, 5, 5};
    scene.bounds.upper += Vec3{5, 5, 5};
    Scene walled = scene;
    walled.periodic = false;
    for (const ResponseMethod method : {ResponseMethod::massSplit, ResponseMethod::coloured}) {
        CAPTURE(name(method));
        constexpr int steps = 20;  // in which nobody gets to the faces
        CHECK(stateHash(gasAfter(scene, Device::cpu, method, steps)) ==
              stateHash(gasAfter(walled, Device::cpu, method, steps)));
    }
}

TEST_CASE("a periodic box is refused with gravity, and to responses that need walls",
          "[stability]") {
    using enum ResponseMethod;
    Scene scene = periodicGas(0.3f);
    for (const ResponseMethod method : {warm, smallSteps, penalty}) {
        const std::string message = refusalOf(scene, method);
        CHECK(test::contains(message, "the response " + name(method)));
        CHECK(test::contains(message, "use mass-split, racy, atomic, jacobi or coloured"));
    }
    scene.gravity = {0, -1, 0};
    CHECK(test::contains(refusalOf(scene), "use gravity 0, or walls"));
}

TEST_CASE("the option --periodic makes any scene's world periodic", "[stability]") {
    Options options;
    options.scene = "elastic_gas";
    options.count = 343;
    CHECK_FALSE(sceneFor(options).periodic);
    options.periodic = true;
    CHECK(settingsFor(sceneFor(options), Device::cpu).periodic);
}

TEST_CASE("a periodic box that is too small for three cells is refused", "[stability]") {
    CHECK(test::contains(refusalOf(crowdedBox(8, 3.7f, 1.25f)), "is too small for cells of 1.25"));
    CHECK(refusalOf(crowdedBox(8, 3.76f, 1.25f)) == "(nothing was thrown)");
    Scene flat = crowdedBox(8, 8.0f, 1.25f);
    flat.bounds.upper.z = flat.bounds.lower.z + 3.0f;
    CHECK(test::contains(refusalOf(flat), "a periodic box of 3.000000 m"));
}
