// Bodies that do not move, on a picture or seen from all sides.
#include <iostream>

#include "common/film.h"
#include "common/progress.h"

namespace ballpit {

void showSpheres(const Options& options, Bounds world, const Spheres& spheres) {
    Film film(options, world);
    if (!film.isRolling()) return;
    const int frames = options.out.empty() ? 1 : options.frames;
    StopRequest stop;
    for (int k = 0; k < frames && !StopRequest::received(); ++k) {
        film.capture(spheres.positions, spheres.radii, spheres.colors);
        film.walkAround(360.0f / static_cast<float>(frames));
    }
    film.finish();
    for (const std::string& path : {options.png, options.out})
        if (!path.empty()) std::cerr << "saved " << path << '\n';
}

}  // namespace ballpit
