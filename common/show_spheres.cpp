// Bodies that the engine does not move: on a picture, seen from all sides, or as a chapter moves
// them.
#include <algorithm>
#include <iostream>

#include "common/film.h"
#include "common/progress.h"

namespace ballpit {

namespace {

constexpr float framesPerSecond = 60.0f;

}  // namespace

void showMotion(const Options& options, Bounds world, Spheres spheres,
                const std::function<void(Spheres&, float)>& look, float stillShare) {
    Film film(options, world);
    if (!film.isRolling()) return;
    const int frames = options.isFilmed() ? options.frames : 1;
    StopRequest stop;
    for (int k = 0; k < frames && !StopRequest::received(); ++k) {
        const float share = static_cast<float>(k) / static_cast<float>(std::max(1, frames - 1));
        look(spheres, options.isFilmed() ? share : stillShare);
        film.capture(spheres.positions, spheres.radii, spheres.colors);
    }
    film.finish();
    for (const std::string& path : {options.png, options.out})
        if (!path.empty()) std::cerr << "saved " << path << '\n';
}

void showSpheres(const Options& options, Bounds world, const Spheres& spheres) {
    Options once = options;
    const float seconds = static_cast<float>(options.frames) / framesPerSecond;
    if (!once.shot.orbit) once.shot.orbit = 360.0f / seconds;
    showMotion(once, world, spheres, [](Spheres&, float) {});
}

}  // namespace ballpit
