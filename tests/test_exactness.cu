// The exactness contract: the same bits on every run, thread count, launch order and machine. The
// golden hashes are also what ties compilers and build types together: each must give them.
#ifdef _OPENMP
#include <omp.h>
#endif

#include <cmath>

#include "tests/support.h"

using namespace ballpit;

namespace {

/// A run short enough for a test and long enough for balls to meet, and the hash it must end with.
/// Large enough for the CPU's loops to be split among threads, except the first.
struct Golden {
    const char* scene;
    int count, steps;
    const char* hash;
};

const std::vector<Golden>& goldenRuns() {
    static const std::vector<Golden> runs{{"gravity_fall", 500, 500, "783392bd3e69b712"},
                                          {"gas", 5000, 100, "c47bddfe6bfc4f39"},
                                          {"pile", 5000, 100, "3bed28b5cf12dfc3"}};
    return runs;
}

std::string hashAfter(const Golden& run, Device device, int steps) {
    const Scene scene = makeScene(run.scene, run.count, 1);
    return hashText(stateHash(test::simulate(scene, test::settingsFor(scene, device), steps)));
}

void setThreads(int count) {
#ifdef _OPENMP
    omp_set_num_threads(count);
#else
    (void)count;
#endif
}

}  // namespace

TEST_CASE("three scenes end with their golden hashes on every device", "[exactness]") {
    const Device device = GENERATE(from_range(test::devices()));
    const Golden run = GENERATE(from_range(goldenRuns()));
    CAPTURE(device, run.scene, run.count, run.steps);
    CHECK(hashAfter(run, device, run.steps) == run.hash);
}

TEST_CASE("two runs give the same bits", "[exactness]") {
    const Device device = GENERATE(from_range(test::devices()));
    const Golden run = GENERATE(from_range(goldenRuns()));
    CAPTURE(device, run.scene);
    CHECK(hashAfter(run, device, 30) == hashAfter(run, device, 30));
}

TEST_CASE("one, two and three threads give the same bits", "[exactness]") {
    const Golden run = GENERATE(from_range(goldenRuns()));
    CAPTURE(run.scene);
    const int before = cpuThreadCount();
    setThreads(1);
    const std::string one = hashAfter(run, Device::cpu, 30);
    for (const int count : {2, 3}) {
        setThreads(count);
        CAPTURE(count);
        CHECK(hashAfter(run, Device::cpu, 30) == one);
    }
    setThreads(before);
}

TEST_CASE("forward, reversed and shuffled launch order give the same bits", "[exactness]") {
    const Golden run = GENERATE(from_range(goldenRuns()));
    CAPTURE(run.scene);
    const std::string forward = hashAfter(run, Device::cpu, 30);
    for (const LaunchOrder order : {LaunchOrder::reversed, LaunchOrder::shuffled}) {
        const test::InOrder inOrder(order);
        CAPTURE(static_cast<int>(order));
        CHECK(hashAfter(run, Device::cpu, 30) == forward);
    }
}

TEST_CASE("timing the stages changes no bit", "[exactness]") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = makeGravityFall(500, 7);
    SimulatorSettings timed = test::settingsFor(scene, device);
    timed.timeStages = true;
    CHECK(stateHash(test::simulate(scene, timed, 60)) ==
          stateHash(test::simulate(scene, test::settingsFor(scene, device), 60)));
}

TEST_CASE("CPU and GPU agree to the last bit over 500 steps", "[exactness][cuda]") {
    if (test::skippedWithoutGpu()) return;
    const Golden run = GENERATE(from_range(goldenRuns()));
    CAPTURE(run.scene);
    CHECK(hashAfter(run, Device::cpu, 500) == hashAfter(run, Device::cuda, 500));
}

TEST_CASE("the racy exhibit depends on the order, the default does not", "[exactness]") {
    const Scene scene = makePile(2000, 1);
    SimulatorSettings settings = test::settingsFor(scene, Device::cpu);
    const auto hashes = [&](ResponseMethod method) {
        settings.response = method;
        std::vector<std::uint64_t> result;
        for (const LaunchOrder order : {LaunchOrder::forward, LaunchOrder::reversed}) {
            const test::InOrder inOrder(order);
            result.push_back(stateHash(test::simulate(scene, settings, 10)));
        }
        return result;
    };
    const std::vector<std::uint64_t> racy = hashes(ResponseMethod::racy);
    const std::vector<std::uint64_t> gathered = hashes(ResponseMethod::massSplit);
    CHECK(racy[0] != racy[1]);
    CHECK(gathered[0] == gathered[1]);
}

TEST_CASE("the atomic exhibit keeps momentum, but its last bits depend on the order",
          "[exactness]") {
    Scene scene = makeUniform(2000, 1);
    // Walls out of reach, so that none takes momentum.
    scene.bounds = {scene.bounds.lower - Vec3{20, 20, 20}, scene.bounds.upper + Vec3{20, 20, 20}};
    SimulatorSettings settings = test::settingsFor(scene, Device::cpu);
    settings.response = ResponseMethod::atomic;
    const Vec3d before = measure(scene.spheres, scene.bounds, scene.gravity, scene.dt).momentum;
    std::vector<std::uint64_t> hashes;
    for (const LaunchOrder order : {LaunchOrder::forward, LaunchOrder::reversed}) {
        const test::InOrder inOrder(order);
        const Spheres end = test::simulate(scene, settings, 10);
        const Metrics after = measure(end, scene.bounds, scene.gravity, scene.dt);
        const Vec3d p = after.momentum;
        CHECK(length(Vec3d{p.x - before.x, p.y - before.y, p.z - before.z}) <
              1e-6 * std::sqrt(2.0 * 2000.0 * after.kineticEnergy));
        hashes.push_back(stateHash(end));
    }
    CHECK(hashes[0] != hashes[1]);
}
