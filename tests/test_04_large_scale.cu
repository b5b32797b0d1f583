// Many balls: nothing is lost, nothing is missed, and the memory is what was predicted. On a GPU a
// million; fewer on a CPU, and fewer still in checked builds, which are slow.
#include "common/host_pairs.h"
#include "tests/grid_search.h"

using namespace ballpit;

namespace {

int manyBalls(Device device) {
#ifdef BALLPIT_CHECKED
    (void)device;
    return 10000;
#else
    return device == Device::cuda ? 1000000 : 100000;
#endif
}

}  // namespace

TEST_CASE("no ball of a large scene is lost or becomes NaN") {
    const Device device = GENERATE(from_range(test::devices()));
    const std::string name = GENERATE("gravity_fall", "uniform", "pile");
    CAPTURE(name);
    const Scene scene = makeScene(name, manyBalls(device), 1);
    const Spheres end = test::simulate(scene, test::settingsFor(scene, device), 10);
    const Metrics metrics = measure(end, scene.bounds, scene.gravity, scene.dt);
    CHECK(metrics.lost == 0);
    CHECK(metrics.notFinite == 0);
    CHECK(end.masses == scene.spheres.masses);
    CHECK(end.radii == scene.spheres.radii);
}

TEST_CASE("in a large scene the grid finds exactly the pairs that the host finds") {
    const Device device = GENERATE(from_range(test::devices()));
    const std::string name = GENERATE("gravity_fall", "uniform", "pile");
    const int steps = GENERATE(0, 10);
    CAPTURE(name, steps);
    const Scene scene = makeScene(name, manyBalls(device), 2);
    const Spheres spheres = test::simulate(scene, test::settingsFor(scene, device), steps);
    const std::vector<Pair> expected = findPairsOnHost(spheres);
    const std::vector<Pair> found = test::gridPairs(spheres, scene.bounds, scene.cellSize, device);
    // Compared as a whole: a failure must not print a million pairs.
    const bool samePairs = found == expected;
    CHECK(found.size() == expected.size());
    CHECK(samePairs);
    if (steps == 0 && name != "gravity_fall") CHECK(found.size() > spheres.count() / 4);
}

TEST_CASE("the first round of a step collides the pairs that the host finds after the motion") {
    const Device device = GENERATE(from_range(test::devices()));
    // Without gravity and velocities the first motion changes nothing.
    Scene scene = makeUniform(manyBalls(device), 3);
    for (Vec3& velocity : scene.spheres.velocities) velocity = {};
    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    CHECK(simulator.step().collisions == findPairsOnHost(scene.spheres).size());
}

TEST_CASE("a simulator takes the memory that was predicted, until its pair list grows") {
    const Device device = GENERATE(from_range(test::devices()));
    const std::size_t pairCapacity = GENERATE(0, 16, 1000000);
    const ResponseMethod response = GENERATE(ResponseMethod::massSplit, ResponseMethod::racy);
    CAPTURE(pairCapacity, static_cast<int>(response));
    const Scene scene = makeUniform(20000, 4);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.pairCapacity = pairCapacity;
    settings.response = response;
    PhysicsSimulator simulator(settings);
    CHECK(simulator.bytes() == PhysicsSimulator::predictedBytes(settings));

    simulator.bodies().upload(scene.spheres);
    const bool grew = simulator.step().overflow > 0;
    CHECK(grew == (pairCapacity == 16));
    CHECK((simulator.bytes() > PhysicsSimulator::predictedBytes(settings)) == grew);
}
