// The broad phase against brute force: none missed, none twice, wherever the balls lie.
#include <cmath>

#include "common/random.h"
#include "tests/grid_search.h"

using namespace ballpit;

namespace {

constexpr Bounds tenCube{{0, 0, 0}, {10, 10, 10}};

Spheres randomSpheres(int count, Bounds box, float smallest, float largest, std::uint64_t seed) {
    Random random(seed);
    Spheres spheres;
    for (int k = 0; k < count; ++k) {
        const Vec3 position = random.uniformIn(box);
        const float radius = smallest + (largest - smallest) * random.uniform(0, 1);
        spheres.add(position, {}, radius, 1.0f, 1.0f);
    }
    return spheres;
}

std::vector<Pair> without(const std::vector<Pair>& all, const std::vector<Pair>& some) {
    std::vector<Pair> rest;
    std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
    return rest;
}

/// The one claim of this file. Pairs found twice are once too many.
void requireSamePairs(const Spheres& spheres, Bounds bounds, float cellSize, Device device) {
    const std::vector<Pair> found = test::gridPairs(spheres, bounds, cellSize, device);
    const std::vector<Pair> expected = test::bruteForcePairs(spheres);
    const std::vector<Pair> missed = without(expected, found), tooMany = without(found, expected);
    const std::vector<Pair> none;
    CHECK(missed == none);
    CHECK(tooMany == none);
}

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

TEST_CASE("the grid finds the same pairs as brute force in random scenes") {
    const Device device = GENERATE(from_range(test::devices()));
    const std::uint64_t seed = GENERATE(range(1, 31));
    CAPTURE(seed);
    const Bounds around{{-7, -5, -3}, {3, 5, 7}};  // negative coordinates too
    const Spheres equal = randomSpheres(400, around, 0.5f, 0.5f, seed);
    REQUIRE(test::bruteForcePairs(equal).size() > 50);
    requireSamePairs(equal, around, 1.0f, device);
    requireSamePairs(equal, around, 1.7f, device);
    requireSamePairs(randomSpheres(400, around, 0.05f, 0.5f, seed), around, 1.0f, device);
}

TEST_CASE("the grid finds the same pairs as brute force for any number of balls") {
    const Device device = GENERATE(from_range(test::devices()));
    const int count = GENERATE(1, 2, 33, 255, 256, 257, 1000);
    CAPTURE(count);
    const float side = 1.2f * std::cbrt(static_cast<float>(count)) + 1.0f;
    const Bounds box{{0, 0, 0}, {side, side, side}};
    requireSamePairs(randomSpheres(count, box, 0.5f, 0.5f, 40), box, 1.0f, device);
}

TEST_CASE("a simulator of no balls is refused") {
    SimulatorSettings settings;
    settings.device = Device::cpu;
    settings.objects = 0;
    CHECK_THROWS_WITH(PhysicsSimulator(settings), "count 0: at least 1 ball");
}

TEST_CASE("the grid finds the same pairs as brute force with 1, 2 or 3 cells a side") {
    const Device device = GENERATE(from_range(test::devices()));
    const int x = GENERATE(1, 2, 3), y = GENERATE(1, 2, 3), z = GENERATE(1, 2, 3);
    CAPTURE(x, y, z);
    const Bounds box{{0, 0, 0},
                     {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}};
    requireSamePairs(randomSpheres(60, box, 0.1f, 0.5f, 41), box, 1.0f, device);
}

TEST_CASE("the grid finds the same pairs as brute force in a row, column or stack of cells") {
    const Device device = GENERATE(from_range(test::devices()));
    const Vec3 size =
        GENERATE(Vec3{40, 1, 1}, Vec3{1, 40, 1}, Vec3{1, 1, 40}, Vec3{40, 2, 1}, Vec3{2, 1, 40});
    CAPTURE(size);
    const Bounds box{{0, 0, 0}, size};
    requireSamePairs(randomSpheres(90, box, 0.2f, 0.5f, 42), box, 1.0f, device);
}

TEST_CASE("the grid finds the same pairs when balls lie on faces, edges and corners of cells") {
    const Device device = GENERATE(from_range(test::devices()));
    const float nudge = GENERATE(0.0f, 1e-6f, -1e-6f);
    CAPTURE(nudge);
    // Radius 0.6 on points 1 m apart: every ball touches its six nearest.
    Spheres spheres;
    for (int k = 0; k < 6 * 6 * 6; ++k) {
        const Vec3 corner{static_cast<float>(k % 6), static_cast<float>(k / 6 % 6),
                          static_cast<float>(k / 36)};
        spheres.add((1.0f + nudge) * corner, {}, 0.6f, 1.0f, 1.0f);
    }
    REQUIRE(test::bruteForcePairs(spheres).size() == 3 * 5 * 6 * 6);
    requireSamePairs(spheres, {{0, 0, 0}, {6, 6, 6}}, 1.25f, device);
    for (float& radius : spheres.radii) radius = 0.5000005f;  // the cells just hold the balls
    requireSamePairs(spheres, {{0, 0, 0}, {6, 6, 6}}, 1.000001f, device);
}

TEST_CASE("the grid finds the same pairs when many balls share a centre or a cell") {
    const Device device = GENERATE(from_range(test::devices()));
    SECTION("one centre") {
        Spheres spheres;
        for (int k = 0; k < 70; ++k) spheres.add({5, 5, 5}, {}, 0.5f, 1.0f, 1.0f);
        REQUIRE(test::bruteForcePairs(spheres).size() == 70 * 69 / 2);
        requireSamePairs(spheres, tenCube, 1.0f, device);
    }
    SECTION("one cell of many") {
        requireSamePairs(randomSpheres(300, {{4, 4, 4}, {5, 5, 5}}, 0.1f, 0.3f, 43), tenCube, 1.0f,
                         device);
    }
    SECTION("one cell, the first or the last") {
        const float at = GENERATE(0.0f, 9.0f);
        const Bounds cell{{at, at, at}, {at + 1, at + 1, at + 1}};
        requireSamePairs(randomSpheres(100, cell, 0.1f, 0.3f, 44), tenCube, 1.0f, device);
    }
}

TEST_CASE("the grid finds the same pairs when balls are outside the world, and counts those") {
    const Device device = GENERATE(from_range(test::devices()));
    const Bounds wide{{-8, -8, -8}, {18, 18, 18}};
    Spheres spheres = randomSpheres(1500, wide, 0.3f, 0.5f, 45);
    spheres.positions[7] = {1e30f, -1e30f, 5};
    spheres.positions[8] = {3e9f, 5, 5};
    spheres.positions[9] = {3e9f, 5, 5};
    requireSamePairs(spheres, tenCube, 1.0f, device);
    std::uint32_t outside = 0;
    for (const Vec3 position : spheres.positions) outside += !contains(tenCube, position);
    CHECK(test::GridSearch(spheres, tenCube, 1.0f, device).outside() == outside);
}

TEST_CASE("a coordinate just below the grid is not in its first cell") {
    CHECK(cellAlongAxis(-0.25f, 0.0f, 1.0f, 8) == -1);
    CHECK(cellAlongAxis(0.0f, 0.0f, 1.0f, 8) == 0);
    CHECK(cellAlongAxis(7.75f, 0.0f, 1.0f, 8) == 7);
    CHECK(cellAlongAxis(8.0f, 0.0f, 1.0f, 8) == 8);
    CHECK(cellAlongAxis(1e30f, 0.0f, 1.0f, 8) == 8);
    CHECK(cellAlongAxis(-1e30f, 0.0f, 1.0f, 8) == -1);
    CHECK(cellAlongAxis(std::nanf(""), 0.0f, 1.0f, 8) == -1);
}

TEST_CASE("every cell has its own hash below the cell count, and the hash gives the cell back") {
    const Int3 resolution{3, 4, 5};
    std::uint32_t next = 0;  // x runs fastest, then y, then z
    for (int z = 0; z < 5; ++z)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 3; ++x) {
                CHECK(cellHash(resolution, {x, y, z}) == next);
                CHECK(isSameCell(cellFromHash(resolution, next), {x, y, z}));
                ++next;
            }
}

TEST_CASE("points without radius touch nothing but the balls that cover them") {
    const Device device = GENERATE(from_range(test::devices()));
    Spheres spheres = randomSpheres(300, {{0, 0, 0}, {4, 4, 4}}, 0.0f, 0.0f, 46);
    CHECK(test::gridPairs(spheres, tenCube, 1.0f, device).empty());
    for (std::size_t k = 0; k < 50; ++k) spheres.radii[k] = 0.5f;
    REQUIRE(test::bruteForcePairs(spheres).size() > 50);
    requireSamePairs(spheres, tenCube, 1.0f, device);
}

// Far from the grid's origin, rounding may put two balls that touch across a cell two cells apart.
// UniformGrid makes its cells a hair larger for this test's sake; without the hair it fails.
TEST_CASE("balls that just touch across cell faces are found in a grid of a thousand cells") {
    const Device device = GENERATE(from_range(test::devices()));
    const float diameter = GENERATE(1.0f, 0.7f, 0.3f);
    const int axis = GENERATE(0, 1, 2);
    const std::uint64_t seed = GENERATE(range(1, 6));
    CAPTURE(diameter, axis, seed);
    const auto onAxis = [&](float x) {
        return axis == 0 ? Vec3{x, 0, 0} : axis == 1 ? Vec3{0, x, 0} : Vec3{0, 0, x};
    };
    const float length = 1000.0f * diameter, lastBits = 0x1p-23f * length;
    Random random(seed);
    Spheres spheres;
    for (int k = 1; k < 1000; ++k) {
        const float face = -static_cast<float>(k) * diameter;
        const Vec3 position = onAxis(face + random.uniform(-lastBits, lastBits));
        spheres.add(position, {}, 0.5f * diameter, 1.0f, 1.0f);
    }
    REQUIRE(test::bruteForcePairs(spheres).size() > 300);
    const Vec3 across{diameter, diameter, diameter};
    requireSamePairs(spheres, {onAxis(-length), across - onAxis(diameter)}, diameter, device);
}

TEST_CASE("the cells of a row know their slots, whatever was in the grid before") {
    const Device device = GENERATE(from_range(test::devices()));
    const int count = GENERATE(1, 2, 7, 30, 300);
    const std::uint64_t seed = GENERATE(range(1, 6));
    CAPTURE(count, seed);
    Random random(seed);
    std::vector<std::uint32_t> hashes;
    for (int k = 0; k < count; ++k)
        hashes.push_back(static_cast<std::uint32_t>(random.next() % 60));
    std::sort(hashes.begin(), hashes.end());

    UniformGrid grid(device, {{0, 0, 0}, {5, 4, 3}}, 1.0f, count);
    grid.sortedHashes.upload(hashes);
    grid.cellStarts.upload(std::vector<std::uint32_t>(60, 0));
    grid.cellEnds.upload(std::vector<std::uint32_t>(60, 1000));
    clearCells(grid);
    launch<findCellStart>(device, count, count, View<const std::uint32_t>(grid.sortedHashes.view()),
                          grid.view());

    const auto starts = grid.cellStarts.download(), ends = grid.cellEnds.download();
    for (std::uint32_t cells = 1; cells <= 3; ++cells)
        for (std::uint32_t first = 0; first + cells <= 60; ++first) {
            const auto begin = std::lower_bound(hashes.begin(), hashes.end(), first);
            const auto end = std::lower_bound(begin, hashes.end(), first + cells);
            CAPTURE(first, cells);
            if (begin == end) {
                CHECK(starts[first] >= ends[first + cells - 1]);
            } else {
                CHECK(starts[first] == static_cast<std::uint32_t>(begin - hashes.begin()));
                CHECK(ends[first + cells - 1] == static_cast<std::uint32_t>(end - hashes.begin()));
            }
        }
}

TEST_CASE("every launch order finds the same list, pair by pair") {
    const Device device = GENERATE(from_range(test::devices()));
    const LaunchOrder order = GENERATE(LaunchOrder::reversed, LaunchOrder::shuffled);
    CAPTURE(static_cast<int>(order));
    const Scene scene = makePile(1000, 2);
    const auto listed = [&] {
        return test::GridSearch(scene.spheres, scene.bounds, scene.cellSize, device, 10000)
            .stored();
    };
    const std::vector<Pair> forward = listed();
    const test::InOrder scope(order);
    CHECK(listed() == forward);
}

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
