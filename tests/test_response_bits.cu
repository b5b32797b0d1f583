// The exactness contract for the responses of chapter 11, and the colours it rests on.
#ifdef _OPENMP
#include <omp.h>
#endif

#include <set>

#include "common/host_pairs.h"
#include "common/one_round.cuh"
#include "tests/response_scenes.h"

using namespace ballpit;

namespace {

/// Scenes large enough for the CPU's loops to be split among threads.
Scene sceneNamed(const std::string& name) {
    return name == "gas" ? test::gasOf(2500, 0.4, 0.9f, 2.0f, 4) : makePile(2500, 1);
}

std::string hashAfter(const Scene& scene, Device device, ResponseMethod method, int steps) {
    return hashText(
        stateHash(test::simulate(scene, test::settingsFor(scene, device, method), steps)));
}

void setThreads(int count) {
#ifdef _OPENMP
    omp_set_num_threads(count);
#else
    (void)count;
#endif
}

}  // namespace

TEST_CASE("with each response one, two and three threads give the same bits", "[stability]") {
    const ResponseMethod method = GENERATE(from_range(test::newMethods()));
    const Scene scene = sceneNamed(GENERATE("gas", "pile"));
    CAPTURE(method, scene.name);
    const int before = cpuThreadCount();
    setThreads(1);
    const std::string one = hashAfter(scene, Device::cpu, method, 6);
    for (const int count : {2, 3}) {
        setThreads(count);
        CAPTURE(count);
        CHECK(hashAfter(scene, Device::cpu, method, 6) == one);
    }
    setThreads(before);
}

TEST_CASE("each response ends with its golden hash on every device", "[stability]") {
    struct Golden {
        ResponseMethod method;
        const char* scene;
        const char* hash;
    };
    using enum ResponseMethod;
    const Device device = GENERATE(from_range(test::devices()));
    const std::vector<Golden> runs{
        {jacobi, "gas", "2d9fdbc3e57bec1a"},     {jacobi, "pile", "d01805ebda3879cc"},
        {coloured, "gas", "1c43b6138854fff2"},   {coloured, "pile", "0bf00ea6747c18fa"},
        {warm, "gas", "370f048566846c95"},       {warm, "pile", "eb59cb172b5906fd"},
        {smallSteps, "gas", "3a9e42173c97e073"}, {smallSteps, "pile", "84c7e55c426781c0"},
        {penalty, "gas", "813d29d2a5bd9ab9"},    {penalty, "pile", "d35b02bec890ceb6"}};
    for (const Golden& run : runs) {
        CAPTURE(device, run.method, run.scene);
        CHECK(hashAfter(sceneNamed(run.scene), device, run.method, 20) == run.hash);
    }
}

TEST_CASE("with each response any order of the threads gives the same bits", "[stability]") {
    const ResponseMethod method = GENERATE(from_range(test::newMethods()));
    const Scene scene = sceneNamed(GENERATE("gas", "pile"));
    CAPTURE(method, scene.name);
    const std::string forward = hashAfter(scene, Device::cpu, method, 6);
    for (const LaunchOrder order : {LaunchOrder::reversed, LaunchOrder::shuffled}) {
        const test::InOrder inOrder(order);
        CAPTURE(static_cast<int>(order));
        CHECK(hashAfter(scene, Device::cpu, method, 6) == forward);
    }
}

TEST_CASE("CPU and GPU agree to the last bit with each response over 120 steps",
          "[stability][cuda]") {
    if (test::skippedWithoutGpu()) return;
    const ResponseMethod method = GENERATE(from_range(test::newMethods()));
    const Scene scene = sceneNamed(GENERATE("gas", "pile"));
    CAPTURE(method, scene.name);
    // Jacobi's pile boils but stays finite; its gas at e = 0.9 as well.
    CHECK(hashAfter(scene, Device::cpu, method, 120) ==
          hashAfter(scene, Device::cuda, method, 120));
}

TEST_CASE("a full pair list and a rehearsal change no bit of what warm remembers", "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = test::pileOf(300, 0.2f, 3);
    SimulatorSettings settings = test::settingsFor(scene, device, ResponseMethod::warm);
    const std::uint64_t plain = stateHash(test::simulate(scene, settings, 60));
    settings.pairCapacity = 16;
    CHECK(stateHash(test::simulate(scene, settings, 60)) == plain);

    PhysicsSimulator simulator(test::settingsFor(scene, device, ResponseMethod::warm));
    simulator.bodies().upload(scene.spheres);
    for (int k = 0; k < 60; ++k) {
        simulator.rehearseStep();
        simulator.step();
    }
    CHECK(stateHash(simulator.bodies().download()) == plain);
}

namespace {

/// `count` balls without meaning, and pairs drawn at random among them.
OneRound randomPairs(Device device, int count, int pairCount, std::uint64_t seed) {
    Spheres spheres;
    for (int k = 0; k < count; ++k) spheres.add({}, {}, 0.5f, 1.0f, 1.0f);
    std::set<std::pair<std::uint32_t, std::uint32_t>> drawn;
    Random random(seed);
    while (static_cast<int>(drawn.size()) < pairCount) {
        const auto any = [&] {
            return static_cast<std::uint32_t>(random.next() % static_cast<std::uint64_t>(count));
        };
        const std::uint32_t a = any(), b = any();
        if (a != b) drawn.insert({std::min(a, b), std::max(a, b)});
    }
    std::vector<Pair> pairs;
    for (const auto& [a, b] : drawn) pairs.push_back({a, b});
    return {device, spheres, pairs};
}

template <class T>
std::vector<T> fetched(Device device, const View<T>& view, std::size_t count) {
    std::vector<T> host(count);
    copyToHost(device, host.data(), view.data, count * sizeof(T));
    return host;
}

/// What the colouring came to, on the host.
struct Colours {
    std::vector<Pair> pairs;
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<std::uint32_t> overflow;

    Colours(Device device, const PairsView& list, const Colouring& colouring) {
        const ColouringView& view = colouring.view();
        const std::size_t stored = fetched(device, list.starts, list.starts.count).back();
        pairs = fetched(device, list.pairs, stored);
        const auto counts = fetched(device, view.counts, colourCount);
        for (int c = 0; c < colourCount; ++c) {
            const auto all = fetched(device, view.lists, view.lists.count);
            const auto begin = all.begin() + c * static_cast<std::ptrdiff_t>(view.stride);
            lists.emplace_back(begin, begin + counts[static_cast<std::size_t>(c)]);
            std::sort(lists.back().begin(), lists.back().end());
        }
        const std::size_t left =
            fetched(device, view.overflowStarts, view.overflowStarts.count).back();
        overflow = fetched(device, view.overflow, left);
    }

    bool isProper() const {
        for (const auto& list : lists) {
            std::set<std::uint32_t> bodies;
            for (const std::uint32_t k : list)
                if (!bodies.insert(pairs[k].first).second || !bodies.insert(pairs[k].second).second)
                    return false;
        }
        return true;
    }

    /// Every pair in one list, once, and the overflow in order.
    bool isComplete() const {
        std::vector<std::uint32_t> all = overflow;
        for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
        std::sort(all.begin(), all.end());
        for (std::uint32_t k = 0; k < all.size(); ++k)
            if (all[k] != k) return false;
        return all.size() == pairs.size() && std::is_sorted(overflow.begin(), overflow.end());
    }
};

}  // namespace

TEST_CASE("no two pairs of a colour share a body, and every pair has one", "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    struct Size {
        int bodies, pairs;
    };
    const Size size = GENERATE(Size{2, 0}, Size{2, 1}, Size{30, 435}, Size{40, 300},
                               Size{3000, 9000}, Size{300, 6000});
    CAPTURE(device, size.bodies, size.pairs);
    OneRound round = randomPairs(device, size.bodies, size.pairs, 11);
    const PairsView pairs = round.round().pairs;
    Colouring colouring(device, static_cast<std::size_t>(size.bodies),
                        static_cast<std::size_t>(size.pairs));
    for (const bool inRounds : {false, true}) {
        CAPTURE(inRounds);
        colouring.colour(pairs, inRounds);
        const Colours colours(device, pairs, colouring);
        CHECK(colours.isProper());
        CHECK(colours.isComplete());
    }
}

TEST_CASE("one thread in order and many threads in rounds give the same colours", "[stability]") {
    const int pairCount = GENERATE(1, 100, 6000, 12000, 30000);
    CAPTURE(pairCount);
    OneRound round = randomPairs(Device::cpu, 1500, pairCount, 12);
    const PairsView pairs = round.round().pairs;
    Colouring colouring(Device::cpu, 1500, static_cast<std::size_t>(pairCount));
    colouring.colour(pairs, false);
    const Colours inOrder(Device::cpu, pairs, colouring);
    for (const LaunchOrder order :
         {LaunchOrder::forward, LaunchOrder::reversed, LaunchOrder::shuffled}) {
        const test::InOrder launched(order);
        colouring.colour(pairs, true);
        const Colours inRounds(Device::cpu, pairs, colouring);
        CHECK(inRounds.lists == inOrder.lists);
        CHECK(inRounds.overflow == inOrder.overflow);
    }
}

TEST_CASE("the contacts of equal balls need no overflow", "[stability]") {
    const Scene scene = makePile(8000, 1);
    const std::vector<Pair> pairs = findPairsOnHost(scene.spheres);
    OneRound round(Device::cpu, scene.spheres, pairs);
    Colouring colouring(Device::cpu, scene.spheres.count(), pairs.size());
    colouring.colour(round.round().pairs);
    CHECK(Colours(Device::cpu, round.round().pairs, colouring).overflow.empty());
}

TEST_CASE("a hub with more contacts than colours is resolved exactly and in any order",
          "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld(9.0f);
    scene.spheres.add({0, 0, 0}, {0, 0, 0}, 4.0f, 50.0f, 1.0f);
    Random random(9);
    std::vector<float> radii(150, 0.3f);
    for (int k = 0; k < 150; ++k) {
        // Even points on a sphere: a spiral.
        const float y = 1.0f - (float(k) + 0.5f) / 75.0f, angle = 2.39996323f * float(k);
        const float ring = std::sqrt(1.0f - y * y);
        const Vec3 direction{ring * std::cos(angle), y, ring * std::sin(angle)};
        scene.spheres.add(4.32f * direction,
                          -2.0f * direction + random.uniformIn({{0, 0, 0}, {1, 1, 1}}), 0.3f, 1.0f,
                          1.0f);
    }
    std::vector<Pair> pairs;
    for (std::uint32_t k = 1; k <= 150; ++k) pairs.push_back({0, k});
    ColouredResponse response(device, 151, 150, {1.0f, 1.0f, 0.0f});
    const Spheres once = OneRound(device, scene.spheres, pairs).resolve(response);
    int untouched = 0;
    for (std::size_t k = 1; k <= 150; ++k)
        untouched += once.velocities[k] == scene.spheres.velocities[k];
    CHECK(untouched == 0);

    SimulatorSettings settings = test::settingsFor(scene, device, ResponseMethod::coloured);
    const Spheres end = test::simulate(scene, settings, 5);
    const Metrics before = test::measureIn(scene, scene.spheres);
    const Metrics after = test::measureIn(scene, end);
    CHECK(after.kineticEnergy == Approx(before.kineticEnergy).epsilon(1e-5));
    const Vec3d p = before.momentum, q = after.momentum;
    CHECK(length(Vec3d{q.x - p.x, q.y - p.y, q.z - p.z}) < 1e-3);
    for (const LaunchOrder order : {LaunchOrder::reversed, LaunchOrder::shuffled}) {
        const test::InOrder inOrder(order);
        CHECK(stateHash(test::simulate(scene, settings, 5)) == stateHash(end));
    }
}
