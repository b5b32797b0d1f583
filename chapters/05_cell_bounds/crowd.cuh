// The chapter's film: balls drift, and every frame has cell bounds of its own.
#pragma once

#include "chapters/05_cell_bounds/population.cuh"
#include "common/coloring.h"
#include "common/film.h"
#include "common/motion.h"

namespace ballpit {

/// From blue, nobody around, to orange: 20 balls or more.
inline void colorByCrowd(Spheres& spheres, Population population) {
    const auto around = population.around<true>(), balls = population.balls();
    for (std::size_t slot = 0; slot < around.size(); ++slot)
        spheres.colors.at(balls[slot]) = rampColor(static_cast<float>(around[slot]) / 20.0f);
}

inline void showCrowd(const Options& options, const Scene& scene) {
    Scene now = scene;
    stir(now.spheres, {1.5f, 1.5f, 1.5f}, options.seed + 1);
    showMotion(options, scene.bounds, {}, [&](Spheres& shown, float share) {
        if (share > 0) drift(now.spheres, scene.bounds);
        colorByCrowd(now.spheres, Population(options.device, now));
        shown = now.spheres;
    });
}

}  // namespace ballpit
