// The bench's whole story: balls are dropped into a box and come to rest. How long a step takes on
// the average, and how deep the balls overlap on the way and at the end.
#pragma once

#include <algorithm>
#include <cstdio>
#include <vector>

#include "10_full_system/physics_simulator.cuh"
#include "common/metrics.h"
#include "common/timing.h"
#include "stability/scenes.h"

namespace ballpit {

struct DropPlan {
    Device device = Device::cpu;
    std::vector<int> counts{10000};
    std::vector<int> substeps;  ///< of small-steps; none: its own
    int repeats = 3;            ///< runs of the story
    int rest = 0;               ///< steps after the fall, untimed, for the balls to come to rest
};

/// What one fall of 120 steps was like. `ms` are sums; overlaps in m.
struct Drop {
    double ms = 0.0, msOfLaterHalf = 0.0;
    int listsForEachSubstep = 0;
    double meanOverlap = 0.0;  ///< averaged over balls' contacts and time
    Metrics end;
};

constexpr int dropSteps = 120;

inline Drop dropOnce(const Scene& scene, const SimulatorSettings& settings, int rest) {
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    const auto measured = [&] {
        return measure(simulator.bodies().download(), scene.bounds, scene.gravity, scene.dt);
    };
    constexpr int measureEvery = 10;
    Drop drop;
    for (int step = 1; step <= dropSteps; ++step) {
        const StepStats stats = simulator.step();
        drop.ms += stats.frameTimeMs;
        if (step > dropSteps / 2) drop.msOfLaterHalf += stats.frameTimeMs;
        drop.listsForEachSubstep += stats.gridRebuilt;
        if (step % measureEvery == 0)
            drop.meanOverlap += measured().meanPenetration * measureEvery / dropSteps;
    }
    for (int step = 0; step < rest; ++step) simulator.step();
    drop.end = measured();
    return drop;
}

/// One line: medians over the runs. Energy at the end is told in that of the fall of one step.
inline void printDrop(const Scene& scene, const SimulatorSettings& settings, const DropPlan& plan) {
    std::vector<double> all, later;
    Drop drop;
    for (int run = 0; run < plan.repeats; ++run) {
        drop = dropOnce(scene, settings, plan.rest);
        all.push_back(drop.ms / dropSteps);
        later.push_back(drop.msOfLaterHalf / (dropSteps / 2));
    }
    const double radius = stability::ballRadius, fall = length(scene.gravity) * scene.dt;
    const double energyOfFall = 0.5 * fall * fall * static_cast<double>(scene.spheres.count());
    std::printf(
        "%8zu %8d %9.2f %9.2f %6d %12.5f %10.3f %% %9.2f %% %12.2e\n", scene.spheres.count(),
        settings.substeps.value_or(*completed(settings.response, {}, 9.81f, settings.dt).substeps),
        median(all), median(later), drop.listsForEachSubstep, drop.meanOverlap,
        100.0 * drop.end.meanPenetration / radius, 100.0 * drop.end.largestPenetration / radius,
        drop.end.kineticEnergy / energyOfFall);
    std::fflush(stdout);
}

inline void runDropBench(const DropPlan& plan) {
    requireUsable(plan.device);
    std::printf(
        "Balls of r 0.5 m dropped into a box, small-steps, %s, %d steps of 1/60 s, median "
        "of %d runs%s.\n"
        "Overlap of contacts: mean over the fall in m; at the end mean and largest in r. "
        "Energy: kinetic, over that of a step's fall.\n",
        name(plan.device), dropSteps, plan.repeats,
        plan.rest ? (", then " + std::to_string(plan.rest) + " to rest").c_str() : "");
    std::printf("%8s %8s %9s %9s %6s %12s %12s %11s %12s\n", "balls", "substeps", "ms a step",
                "61 to 120", "lists", "overlap, m", "mean at end", "largest", "energy");
    for (const int count : plan.counts) {
        const Scene scene = stability::makeDeepPile(count, 1);
        SimulatorSettings settings = settingsFor(scene, plan.device);
        settings.response = ResponseMethod::smallSteps;
        if (plan.substeps.empty()) printDrop(scene, settings, plan);
        for (const int substeps : plan.substeps) {
            settings.substeps = substeps;
            printDrop(scene, settings, plan);
        }
    }
}

}  // namespace ballpit
