// The bench's parts: scenes in cell order, the check before the clock, medians, the table.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "10_full_system/physics_simulator.cuh"
#include "bench/plain_grid.h"
#include "bench/report.h"
#include "common/scene.h"
#include "common/timing.h"

namespace ballpit {

struct BenchPlan {
    Device device = Device::cpu;
    std::vector<int> counts;
    std::vector<std::string> scenes{"uniform", "gas", "pile"};
    int repeats = 15;
    std::string csv;
};

/// Bytes a second that a large copy within the device's memory moves, read and written.
inline double copyBandwidth(Device device) {
    const std::size_t bytes = device == Device::cuda ? std::size_t{1} << 30 : std::size_t{1} << 28;
    DeviceBuffer<std::byte> from(device, bytes), to(device, bytes);
    std::vector<double> times;
    for (int k = 0; k < 5; ++k) {
        const double start = milliseconds();
        copyWithin(device, to.data(), from.data(), bytes);
        synchronize(device);
        times.push_back(milliseconds() - start);
    }
    return 2.0 * static_cast<double>(bytes) / (1e-3 * median(times));
}

/// The search alone: hash, sort, reorder, cell bounds, pair list. Buffers are kept.
class PairSearch {
public:
    PairSearch(const Scene& scene, Device device)
        : device_(device),
          count_(static_cast<int>(scene.spheres.count())),
          bodies_(device, scene.spheres.count()),
          grid_(device, scene.bounds, scene.cellSize, count_),
          pairs_(device, scene.spheres.count(), 4 * scene.spheres.count()),
          status_(device, 1),
          scratch_(device, 0) {
        status_.fill(0);
        bodies_.upload(scene.spheres);
    }

    void run() {
        const BodiesView from = bodies_.view({0, 0}), to = bodies_.view({1, 1});
        launch<computeGridHash>(device_, count_, grid_.view(), from.positions, grid_.hashes.view(),
                                grid_.indices.view(), status_.view());
        sortByHash(device_, count_, grid_, scratch_);
        clearCells(grid_);
        launch<reorderAndFindCells>(device_, count_, count_, grid_.sortedHashes.view(),
                                    grid_.sortedIndices.view(), from, to, grid_.view());
        findPairsGrid(device_, count_, grid_.view(), grid_.sortedHashes.view(), to.positions,
                      pairs_, status_.view(), scratch_);
        synchronize(device_);
    }

    /// The pairs of the last run by body number, sorted. Grows the list if it was too short.
    std::vector<Pair> pairs() {
        const std::uint32_t found = pairs_.starts.download().back();
        if (found > pairs_.pairs.count()) {
            pairs_.pairs.resize(found);
            run();
        }
        const std::vector<std::uint32_t> bodies = grid_.sortedIndices.download();
        std::vector<Pair> pairs = pairs_.pairs.download(found);
        for (Pair& pair : pairs) {
            const std::uint32_t a = bodies[pair.first], b = bodies[pair.second];
            pair = {std::min(a, b), std::max(a, b)};
        }
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }

private:
    Device device_;
    int count_;
    RigidBodySystem bodies_;
    UniformGrid grid_;
    PairList pairs_;
    DeviceBuffer<StepStatus> status_;
    Scratch scratch_;
};

/// The same balls, numbered in the order of their cells: how the engine finds them from the second
/// step on.
inline Scene inCellOrder(Scene scene) {
    UniformGrid grid(Device::cpu, scene.bounds, scene.cellSize, 1);
    const GridView view = grid.view();
    const Spheres& old = scene.spheres;
    std::vector<std::pair<std::uint32_t, std::size_t>> order;
    for (std::size_t k = 0; k < old.count(); ++k)
        order.emplace_back(
            cellHash(view.resolution, clampToGrid(view, cellOf(view, old.positions[k]))), k);
    std::sort(order.begin(), order.end());
    Spheres sorted;
    for (const auto& [hash, k] : order)
        sorted.add(old.positions[k], old.velocities[k], old.radii[k], old.masses[k],
                   old.restitutions[k], old.colors[k]);
    scene.spheres = sorted;
    return scene;
}

/// Throws unless the engine and the plain grid find the same pairs: no time is shown before that.
inline void requireSamePairs(const Scene& scene, PairSearch& search, PlainGrid& plain) {
    search.run();
    plain.findPairs(scene.spheres.positions, scene.spheres.radii[0]);
    std::vector<Pair> expected;
    for (const auto& list : plain.pairs())
        for (const Pair pair : list)
            expected.push_back(
                {std::min(pair.first, pair.second), std::max(pair.first, pair.second)});
    std::sort(expected.begin(), expected.end());
    const std::vector<Pair> found = search.pairs();
#ifdef BALLPIT_INEXACT
    // Without exact arithmetic, pairs that just touch may be seen or not.
    const double difference = std::abs(double(found.size()) - double(expected.size()));
    const bool same = difference <= 1e-3 * static_cast<double>(expected.size());
#else
    const bool same = found == expected;
#endif
    if (!same)
        throw std::runtime_error("wrong pairs in scene " + scene.name + " with " +
                                 std::to_string(scene.spheres.count()) + " balls: nothing timed");
}

/// Hash to pair list against the plain grid, turn by turn.
inline SearchRow timeSearch(const Scene& scene, const BenchPlan& plan, const std::string& order) {
    PairSearch search(scene, plan.device);
    PlainGrid plain(scene.bounds, scene.cellSize);
    requireSamePairs(scene, search, plain);
    std::vector<double> ours, theirs, ratios;
    for (int k = 0; k < plan.repeats; ++k) {
        const double start = milliseconds();
        search.run();
        const double between = milliseconds();
        plain.findPairs(scene.spheres.positions, scene.spheres.radii[0]);
        ours.push_back(between - start);
        theirs.push_back(milliseconds() - between);
        ratios.push_back(ours.back() / theirs.back());
    }
    const double balls = static_cast<double>(scene.spheres.count());
    return {scene.name,
            order,
            scene.spheres.count(),
            static_cast<double>(search.pairs().size()) / balls,
            median(ours),
            median(theirs),
            median(ratios)};
}

/// The scene as it is after a few steps: overlaps of the start resolved, a gas mixed.
inline Scene settled(Scene scene, Device device, int steps) {
    PhysicsSimulator simulator(settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    for (int k = 0; k < steps; ++k) simulator.step();
    scene.spheres = simulator.bodies().download();
    return scene;
}

/// Whole steps from one and the same state.
inline StepRow timeSteps(const Scene& scene, const BenchPlan& plan, double bandwidth) {
    StepRow row{.scene = scene.name, .balls = scene.spheres.count()};
    {
        PhysicsSimulator simulator(settingsFor(scene, plan.device));
        simulator.bodies().upload(scene.spheres);
        for (int k = 0; k < 3; ++k) simulator.rehearseStep();
        std::vector<double> times;
        for (int k = 0; k < plan.repeats; ++k)
            times.push_back(simulator.rehearseStep().frameTimeMs);
        row.stepMs = median(times);
    }
    SimulatorSettings timed = settingsFor(scene, plan.device);
    timed.timeStages = true;
    PhysicsSimulator simulator(timed);
    simulator.bodies().upload(scene.spheres);
    simulator.rehearseStep();
    std::vector<std::vector<double>> stageTimes;
    for (int k = 0; k < plan.repeats; ++k) {
        const StepStats stats = simulator.rehearseStep();
        stageTimes.resize(stats.stages.size());
        row.stages.resize(stats.stages.size());
        for (std::size_t s = 0; s < stats.stages.size(); ++s) {
            row.stages[s].stage = stats.stages[s].stage;
            stageTimes[s].push_back(stats.stages[s].milliseconds);
        }
        row.contactsPerBall = 2.0 * stats.collisions / static_cast<double>(row.balls);
        row.gridBuilds = stats.gridRebuilt ? *simulator.settings().iterations : 1;
    }
    for (std::size_t s = 0; s < row.stages.size(); ++s)
        row.stages[s].milliseconds = median(stageTimes[s]);
    row.bytes = bytesPerStep(row, simulator.grid().cellCount(), simulator.grid().hashBits(),
                             plan.device, *simulator.settings().iterations);
    row.bandwidthShare = row.bytes / (1e-3 * row.stepMs) / bandwidth;
    return row;
}

inline void runBench(BenchPlan plan) {
    requireUsable(plan.device);
    if (plan.counts.empty()) {
        plan.counts = {1000, 16384, 131072, 1000000};
        if (plan.device == Device::cuda) plan.counts.push_back(8000000);
    }
    constexpr int settlingSteps = 20;
    BenchReport report(plan.device, plan.csv, copyBandwidth(plan.device));
    for (const std::string& name : plan.scenes) {
        for (const int count : plan.counts) {
            const Scene random = makeScene(name, count, 1);
            if (name == "uniform") report.add(timeSearch(random, plan, "random"));
            // The overlaps of `uniform` are its point; the other scenes are timed as they move.
            Scene scene = inCellOrder(
                name == "uniform" ? random : settled(random, plan.device, settlingSteps));
            report.add(timeSearch(scene, plan, "cell"));
            report.add(timeSteps(scene, plan, report.bandwidth()));
        }
    }
    report.finish();
}

}  // namespace ballpit
