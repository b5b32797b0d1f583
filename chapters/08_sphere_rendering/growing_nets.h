// The chapter's film: the nets of a few balls get finer and finer, then the exact spheres stand
// there.
#pragma once

#include "08_sphere_rendering/sphere_renderer.h"
#include "common/film.h"
#include "common/progress.h"

namespace ballpit {

/// Slices at this moment of the film; 0: no nets any more.
inline int slicesAt(float share) {
    constexpr int steps[] = {4, 6, 8, 12, 16, 24, 32};
    constexpr float each = 0.11f;  // of the film
    const auto step = static_cast<std::size_t>(share / each);
    return step < std::size(steps) ? steps[step] : 0;
}

/// The camera walks around by a sixth of a turn.
inline void showGrowingNets(const Options& o, Bounds world, const Spheres& balls) {
    Film film(o, world);
    StopRequest stop;
    for (int k = 0; k < o.frames && !StopRequest::received(); ++k) {
        const float share = static_cast<float>(k) / static_cast<float>(o.frames);
        const int slices = slicesAt(share);
        Shot shot{.zoom = 1.15f, .orbit = 60.0f};
        DrawStyle style;
        style.shape = slices > 0 ? BallShape::gluSpheres : BallShape::impostors;
        style.slices = slices;
        film.look(cameraOf(shot, world, share), style);
        film.capture(balls.positions, balls.radii, balls.colors,
                     slices > 0 ? std::to_string(slices) + " slices" : "exact spheres");
    }
    film.finish();
}

}  // namespace ballpit
