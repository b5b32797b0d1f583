// How long does a whole step take, and how long without the grid? For the lesson's table.
#pragma once

#include "10_full_system/physics_simulator.cuh"
#include "common/findings.h"
#include "common/options.h"
#include "common/timing.h"

namespace ballpit {

/// Counts the balls after ball i that touch it.
HD inline void countNaively(int i, int count, View<const Vec4> positions,
                            View<std::uint32_t> counts) {
    std::uint32_t found = 0;
    for (int j = i + 1; j < count; ++j) found += spheresTouch(positions[i], positions[j]);
    counts[i] = found;
}

/// Writes them to the places that the scan has found.
HD inline void writeNaively(int i, int count, View<const Vec4> positions, PairsView list) {
    std::uint32_t place = list.starts[i];
    for (int j = i + 1; j < count; ++j)
        if (spheresTouch(positions[i], positions[j]) && place < list.pairs.count)
            list.pairs[place++] = pairOf(i, j);
}

/// The same step, but every ball is compared with every other.
class NaiveStep : public EngineStages {
public:
    NaiveStep(const SimulatorSettings& settings, const Spheres& spheres) : EngineStages(settings) {
        bodies_.upload(spheres);
        run();  // the first one shows how long the list must be
        const std::size_t room = 2 * pairs_.starts.download().back();
        pairs_.pairs.resize(room);
        response_->reserve(room);
    }

    void run() {
        const Copies state = bodies_.state();
        Copies now{otherWorkingCopy(state.moving, state.moving), state.fixed};
        beginReport();
        integrate(state, now);
        for (int round = 0; round < *settings_.iterations; ++round) {
            const Copies resolved{otherWorkingCopy(state.moving, now.moving), now.fixed};
            detectNaively(bodies_.view(now).positions);
            resolveCollisions(now, resolved, 1.0f);
            now = resolved;
        }
        sendReport();
        status_.wait();
    }

private:
    void detectNaively(View<const Vec4> positions) {
        launch<countNaively>(settings_.device, count_, count_, positions, pairs_.counts.view());
        exclusiveScan(settings_.device, count_, pairs_.counts.data(), pairs_.starts.data(),
                      scratch_);
        launch<writeNaively>(settings_.device, count_, count_, positions, pairs_.view());
    }
};

/// Nobody waits for the square of more.
constexpr int mostForNaiveStep = 10000;

/// One step of a pile, again and again from the same state.
inline void timeStep(const Options& options) {
    const Scene scene = makePile(options.count, options.seed);
    const SimulatorSettings settings = settingsFor(scene, options.device);
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    Findings findings("10 full_system: one step of a pile");
    findings.add("count", std::int64_t{options.count});
    findings.add("touching pairs", std::int64_t{simulator.rehearseStep().collisions});
    findings.add("milliseconds",
                 medianMilliseconds(options.device, 11, [&] { simulator.rehearseStep(); }));
    if (options.count <= mostForNaiveStep) {
        NaiveStep naive(settings, scene.spheres);
        findings.add("milliseconds, naive",
                     medianMilliseconds(options.device, 5, [&] { naive.run(); }));
    }
    findings.print(options.json);
}

}  // namespace ballpit
