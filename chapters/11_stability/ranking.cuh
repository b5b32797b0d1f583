// Every method on the same three scenes: how wrong it is, and how much work it does.
#pragma once

#include <cmath>

#include "chapters/11_stability/duel.cuh"
#include "common/findings.h"
#include "common/timing.h"

namespace ballpit {

/// How often a step runs over the list of contacts to change bodies.
inline int passesOf(ResponseMethod method, const ResponseKnobs& knobs) {
    using enum ResponseMethod;
    if (method == smallSteps)
        return *knobs.substeps * (*knobs.iterations + 2);  // take back, settle
    if (method == penalty) return *knobs.substeps;
    if (method == warm) return *knobs.iterations + 2;  // start warm, push
    return *knobs.iterations;
}

/// A scene in which every ball has the restitution that the method can give and is nearest to 0.
inline Scene dull(Scene scene, ResponseMethod method) {
    const float least = method == ResponseMethod::penalty ? 0.02f : 0.0f;
    std::fill(scene.spheres.restitutions.begin(), scene.spheres.restitutions.end(), least);
    return scene;
}

inline double overlapAfter(const Scene& scene, ResponseMethod method, Device device, int steps) {
    Side side(scene, {method}, device);
    for (int k = 0; k < steps; ++k) side.step();
    return side.overlap();
}

/// Errors in the gas, the column and the pile of the duels; passes, contacts and time in the pile.
inline void tellRanking(Findings& findings, const Options& options) {
    using enum ResponseMethod;
    for (const ResponseMethod method : {jacobi, massSplit, coloured, warm, smallSteps, penalty}) {
        const std::string who = name(method) + ": ";
        const Device device = options.device;
        Side gas(stability::makeGasOf({.count = 216, .volumeShare = 0.4f, .seed = options.seed}),
                 {method}, device);
        for (int k = 0; k < 80; ++k) gas.step();
        findings.add(who + "gas, energy error", gas.energyShare() - 1);
        findings.add(who + "column, overlap / r",
                     overlapAfter(dull(stability::makeColumn(10, 0), method), method, device, 240));
        Side pile(dull(stability::makeDeepPile(400, options.seed), method), {method}, device);
        for (int k = 0; k < 240; ++k) pile.step();
        findings.add(who + "pile, overlap / r", pile.overlap());
        Side crowd(dull(makePile(500, options.seed), method), {method}, device);
        for (int k = 0; k < 10; ++k) crowd.step();
        findings.add(who + "crowd, fastest m/s", crowd.topSpeed());
        findings.add(who + "passes a step", std::int64_t{passesOf(method, pile.knobs())});
        findings.add(who + "pile, listed pairs a ball",
                     static_cast<double>(pile.listedPairs()) / 400.0);
        findings.add(who + "pile, milliseconds a step",
                     medianMilliseconds(device, 31, [&] { pile.rehearse(); }));
    }
}

}  // namespace ballpit
