// The chapter's film: one ball flies through the others and asks anew in every frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chapters/06_broad_phase/search.cuh"
#include "common/film.h"

namespace ballpit {

/// A closed way around the middle of the world, with two climbs.
inline Vec3 wayThrough(Bounds world, float share) {
    const float turn = 2.0f * std::numbers::pi_v<float> * share;
    const float reach = 0.5f * world.upper.x;
    return {reach * std::sin(turn), 0.6f * reach * std::sin(2.0f * turn), reach * std::cos(turn)};
}

inline void showSeeker(const Options& options, World world) {
    constexpr std::uint32_t seeker = 0;
    showMotion(options, world.bounds, {}, [&](Spheres& shown, float share) {
        world.spheres.positions[seeker] = wayThrough(world.bounds, share);
        Search search(options.device, world);
        search.find();  // again, now that the list is long enough
        const std::vector<std::uint32_t> ids = search.grid.ids();
        const auto slot = std::find(ids.begin(), ids.end(), seeker) - ids.begin();
        const std::vector<Vec4> looks = search.looksFor(static_cast<int>(slot));
        shown = {};
        for (std::size_t k = 0; k < ids.size(); ++k)
            shown.add(world.spheres.positions.at(ids[k]), {}, std::max(0.15f, looks[k].w), 1, 1,
                      xyz(looks[k]));
    });
}

}  // namespace ballpit
