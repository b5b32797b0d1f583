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

inline const std::vector<ResponseMethod>& rankedMethods() {
    using enum ResponseMethod;
    static const std::vector<ResponseMethod> methods{jacobi, massSplit,  coloured,
                                                     warm,   smallSteps, penalty};
    return methods;
}

constexpr int pileCount = 400;
inline Side pileAfter(int steps, ResponseMethod method, const Options& options) {
    return Side(dull(stability::makeDeepPile(pileCount, options.seed), method), {method},
                options.device, steps);
}

/// Errors in a gas, a column, a pile and a crowd; passes and listed pairs in the pile.
inline void tellRanking(Findings& findings, const Options& options) {
    for (const ResponseMethod method : rankedMethods()) {
        const std::string who = name(method) + ": ";
        const auto under = [&](int steps, const Scene& scene) {
            return Side(scene, {method}, options.device, steps);
        };
        const Scene gas =
            stability::makeGasOf({.count = 216, .volumeShare = 0.4f, .seed = options.seed});
        findings.add(who + "gas, energy gained", under(80, gas).energyShare() - 1);
        findings.add(who + "column, overlap / r",
                     under(240, dull(stability::makeColumn(10, 0), method)).overlap());
        Side pile = pileAfter(240, method, options);
        findings.add(who + "pile, overlap / r", pile.overlap());
        findings.add(who + "crowd, fastest m/s",
                     under(10, dull(makePile(500, options.seed), method)).topSpeed());
        findings.add(who + "passes a step", std::int64_t{passesOf(method, pile.knobs())});
        findings.add(who + "pile, listed pairs a ball",
                     static_cast<double>(pile.listedPairs()) / pileCount);
    }
}

/// How long a step of the pile takes with each method, once its balls have met; that of small steps
/// stands for the chapter.
inline void tellSpeeds(Findings& findings, const Options& options) {
    findings.add("count", std::int64_t{pileCount});
    for (const ResponseMethod method : rankedMethods()) {
        Side pile = pileAfter(60, method, options);
        const double time = medianMilliseconds(options.device, 31, [&] { pile.rehearse(); });
        findings.add(name(method) + ": milliseconds", time);
        if (method == ResponseMethod::smallSteps) findings.add("milliseconds", time);
    }
}

}  // namespace ballpit
