// 666 under the original loop and under the plan, filmed as a duel of chapter 11.
#pragma once

#include "chapters/11_stability/duel_film.cuh"
#include "chapters/12_speed_and_accuracy/answer.cuh"

namespace ballpit {

/// What the plan chooses at the start of 666.
inline Fighter chosenFor666(const Options& options) {
    const Scene scene = stability::makeSixCubed(0, options.seed);
    const Plan plan =
        makePlan(factsOf(scene, options.device), worldOf(scene), toleranceOf(scene.name));
    return {plan.response, plan.knobs.iterations.value_or(0), plan.knobs.substeps.value_or(0)};
}

/// The same box with a lower lid, which no ball comes near: seen from closer by.
inline Scene low666(std::uint64_t seed) {
    Scene scene = stability::makeSixCubed(0, seed);
    scene.bounds.upper.y = 2;
    return scene;
}

/// InputError if another scene was asked for.
inline void requireFilmed(const std::string& scene) {
    const auto is666 = [&] {
        return &stability::question(scene) == &stability::question("six_cubed");
    };
    if (scene != "few" && (scene == "every" || !is666()))
        throw InputError("scene '" + scene + "': a picture or a film shows six_cubed here");
}

inline void film666(const Options& options) {
    filmDuel({.scene = "666",
              .make = low666,
              .fails = {originalLoop().method.value()},
              .holds = chosenFor666(options)},
             options);
}

}  // namespace ballpit
