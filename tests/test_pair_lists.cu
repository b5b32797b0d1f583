// Lists of pairs beyond one search: chapter 01's, lists that are full, and the second round of a
// step.
#include "tests/grid_search.h"

using namespace ballpit;
using test::randomSpheres;

namespace {

/// What chapter 01 finds: the stored pairs, sorted, and how many there were.
struct NaivePairs {
    std::vector<Pair> stored;
    std::uint32_t found, beyondTheEnd;
};

NaivePairs naivePairs(const Spheres& spheres, Device device, std::uint32_t capacity) {
    std::vector<Vec4> balls;
    for (std::size_t k = 0; k < spheres.count(); ++k)
        balls.push_back(withW(spheres.positions[k], spheres.radii[k]));
    DeviceBuffer<Vec4> positions(device, balls.size(), "positions");
    positions.upload(balls);
    DeviceBuffer<std::uint32_t> found(device, 1, "found");
    found.fill(0);
    // One place more than the search is told of, to see whether it writes past the end.
    DeviceBuffer<Pair> pairs(device, capacity + 1, "pairs");
    pairs.fill(0xFF);
    View<Pair> window = pairs.view();
    window.count = capacity;
    launchFindPairsNaive(device, static_cast<int>(balls.size()), positions.view(), window,
                         found.view());

    NaivePairs result{pairs.download(), found.download()[0], 0};
    result.beyondTheEnd = result.stored.back().first;
    result.stored.resize(std::min(result.found, capacity));
    std::sort(result.stored.begin(), result.stored.end());
    return result;
}

Spheres pile(int count) { return makePile(count, 1).spheres; }

}  // namespace

TEST_CASE("chapter 01 finds the same pairs as brute force") {
    const Device device = GENERATE(from_range(test::devices()));
    const int count = GENERATE(1, 2, 255, 256, 257, 1000);
    CAPTURE(count);
    const Spheres spheres = randomSpheres(count, {{0, 0, 0}, {6, 6, 6}}, 0.1f, 0.5f, 47);
    const std::vector<Pair> expected = test::bruteForcePairs(spheres);
    const NaivePairs naive = naivePairs(spheres, device, 20000);
    CHECK(naive.found == expected.size());
    CHECK(naive.stored == expected);
}

TEST_CASE("chapter 01 counts the pairs for which there is no room, and writes none of them") {
    const Device device = GENERATE(from_range(test::devices()));
    const std::uint32_t capacity = GENERATE(0, 1, 16);
    CAPTURE(capacity);
    const std::vector<Pair> all = test::bruteForcePairs(pile(300));
    const NaivePairs naive = naivePairs(pile(300), device, capacity);
    CHECK(naive.found == all.size());
    CHECK(naive.beyondTheEnd == 0xFFFFFFFFu);
    CHECK(std::includes(all.begin(), all.end(), naive.stored.begin(), naive.stored.end()));
}

TEST_CASE("a full pair list still counts all pairs, and stores the first of them") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = makePile(1000, 3);
    test::GridSearch all(scene.spheres, scene.bounds, scene.cellSize, device, 10000);
    const test::GridSearch few(scene.spheres, scene.bounds, scene.cellSize, device, 16);
    CHECK(few.found() == test::bruteForcePairs(scene.spheres).size());
    std::vector<Pair> first = all.stored();
    first.resize(16);
    CHECK(few.stored() == first);
}

TEST_CASE("a simulator whose pair list was too short comes to the same state, and says so") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = makePile(1000, 4);
    SimulatorSettings roomy = test::settingsFor(scene, device), tight = roomy;
    roomy.pairCapacity = 100000;
    tight.pairCapacity = 16;
    CHECK(stateHash(test::simulate(scene, tight, 20)) ==
          stateHash(test::simulate(scene, roomy, 20)));

    PhysicsSimulator simulator(tight);
    simulator.bodies().upload(scene.spheres);
    const StepStats first = simulator.step();
    CHECK(first.overflow > 0);
    CHECK(first.collisions > 1000);
    CHECK(simulator.step().overflow == 0);
}

TEST_CASE("pairs that only the second round finds are not lost to a full list") {
    const Device device = GENERATE(from_range(test::devices()));
    // The two in the middle overlap; pushed apart, each meets a neighbour.
    Scene scene = test::emptyWorld();
    for (const float x : {-1.35f, -0.3f, 0.3f, 1.35f})
        scene.spheres.add({x, 0, 0}, {}, 0.5f, 1.0f, 0.5f);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.pairCapacity = 1;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    const StepStats stats = simulator.step();
    CHECK(stats.collisions == 1);
    CHECK(stats.overflow == 1);
    CHECK(simulator.lastPairs() == std::vector<Pair>{{0, 1}, {2, 3}});
    CHECK(simulator.bodies().positions.download()[0].x < -1.4f);
}

TEST_CASE(
    "a simulator that may not grow its pair list fails with both numbers, and keeps its state") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = makePile(1000, 5);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.pairCapacity = 16;
    settings.growPairs = false;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    const std::string message = test::messageOf<std::runtime_error>([&] { simulator.step(); });
    CAPTURE(message);
    CHECK(test::contains(message, "16 available"));
    CHECK(test::contains(message, "pairs needed"));
    const std::size_t digits = message.find_first_of("0123456789");
    REQUIRE(digits != std::string::npos);
    const unsigned long needed = std::stoul(message.substr(digits));
    CHECK(needed > 1000);
    CHECK(stateHash(simulator.bodies().download()) == stateHash(scene.spheres));
}

// The second round of a step sees what the first has moved. A step of one round ends where the
// second round begins, so brute force can say what the second must find.
TEST_CASE("the second round finds all pairs of the bodies where the first round left them") {
    const Device device = GENERATE(from_range(test::devices()));
    const std::uint64_t seed = GENERATE(range(1, 11));
    const float cellSize = GENERATE(1.0f, 1.3f);
    CAPTURE(seed, cellSize);
    Scene scene = test::emptyWorld(cellSize);
    scene.spheres = randomSpheres(200, {{-2, -2, -2}, {2, 2, 2}}, 0.3f, 0.5f, seed);
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.iterations = 1;
    const Spheres between = test::simulate(scene, settings, 1);
    settings.iterations = 2;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    simulator.step();
    CHECK(simulator.lastPairs() == test::bruteForcePairs(between));
}

TEST_CASE("a ball pushed into the neighbour of its neighbour cell is found there") {
    const Device device = GENERATE(from_range(test::devices()));
    const Vec3 direction = GENERATE(Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1});
    CAPTURE(direction);
    // Cells of 2 m with faces at even numbers. A heavy ball pushes a light one by 1.4 m from the
    // first cell into the second, onto a ball in the third.
    Scene scene = test::emptyWorld(2.0f);
    scene.spheres.add(1.8f * direction, {}, 0.9f, 1e6f, 0.5f);
    scene.spheres.add(1.85f * direction, {}, 0.5f, 1.0f, 0.5f);
    scene.spheres.add(4.05f * direction, {}, 0.5f, 1e6f, 0.5f);
    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    const StepStats stats = simulator.step();
    CHECK(stats.collisions == 1);
    CHECK(stats.gridRebuilt);
    CHECK(simulator.lastPairs() == std::vector<Pair>{{1, 2}});
}

TEST_CASE("two balls pushed towards each other from two cells apart are found") {
    const Device device = GENERATE(from_range(test::devices()));
    const float push = GENERATE(0.6f, 0.75f, 0.95f);  // a grid of 2 m bears 0.5 m for this radius
    CAPTURE(push);
    Scene scene = test::emptyWorld(2.0f);
    for (const float side : {-1.0f, 1.0f}) {
        scene.spheres.add({3.0f + side * 1.05f, 0, 0}, {}, 0.5f, 1.0f, 0.5f);
        scene.spheres.add({3.0f + side * (2.45f - push), 0, 0}, {}, 0.9f, 1e6f, 0.5f);
    }
    SimulatorSettings settings = test::settingsFor(scene, device);
    settings.iterations = 1;
    const Spheres between = test::simulate(scene, settings, 1);
    REQUIRE(spheresTouch(withW(between.positions[0], 0.5f), withW(between.positions[2], 0.5f)));
    settings.iterations = 2;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    CHECK(simulator.step().gridRebuilt);
    CHECK(simulator.lastPairs() == test::bruteForcePairs(between));
}

TEST_CASE("the grid is not built twice in a step in which nothing moves far") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld(2.0f);
    scene.spheres.add({0, 0, 0}, {}, 0.5f, 1.0f, 0.5f);
    scene.spheres.add({0.9f, 0, 0}, {}, 0.5f, 1.0f, 0.5f);
    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    CHECK_FALSE(simulator.step().gridRebuilt);
}

TEST_CASE("before the first step there are no last pairs") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = makePile(27, 6);
    PhysicsSimulator simulator(test::settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    CHECK(simulator.lastPairs().empty());
}
