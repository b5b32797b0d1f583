// The chapter's film: the balls light up in the order in which memory holds them.
#pragma once

#include <algorithm>
#include <vector>

#include "common/coloring.h"
#include "common/film.h"

namespace ballpit {

/// How the balls look when the first `read` slots have been read, a warp of 32 at a time: black
/// what the warp reads now, the ramp's colours what was read before, small and pale the rest.
inline void lightUp(Spheres& balls, const std::vector<float>& radii,
                    const std::vector<std::uint32_t>& ids, std::size_t read) {
    constexpr std::size_t warp = 32;
    for (std::size_t slot = 0; slot < ids.size(); ++slot) {
        const std::uint32_t ball = ids[slot];
        const bool isRead = slot < read, isNow = isRead && slot + warp >= read && read < ids.size();
        const float place = static_cast<float>(slot) / static_cast<float>(ids.size());
        balls.radii.at(ball) = isRead ? radii.at(ball) : 0.3f * radii.at(ball);
        balls.colors.at(ball) = isNow    ? Vec3{0.03f, 0.03f, 0.06f}
                                : isRead ? rampColor(place)
                                         : Vec3{0.85f, 0.86f, 0.9f};
    }
}

/// First the balls as they came, then by cell; the picture shows the end.
inline void showReading(const Options& options, Bounds world, const Spheres& balls,
                        const std::vector<std::uint32_t>& asTheyCame,
                        const std::vector<std::uint32_t>& byCell) {
    const auto look = [&, radii = balls.radii](Spheres& shown, float share) {
        const bool first = share < 0.5f;
        const float part = std::min(1.0f, 1.15f * (first ? 2.0f * share : 2.0f * share - 1.0f));
        lightUp(shown, radii, first ? asTheyCame : byCell,
                static_cast<std::size_t>(part * static_cast<float>(radii.size())));
    };
    showMotion(options, world, balls, look, 1.0f);
}

}  // namespace ballpit
