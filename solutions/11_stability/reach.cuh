// Chapter 11: one list of pairs for several moves. A body's reach is how far it may move while the
// list is in use; listed are all pairs whose balls, grown by their reaches, overlap.
//
// Why nothing is missed: a pair not listed had a gap of at least the sum of its two reaches. As
// long as neither body is farther from where it was then than its reach, the gap is not closed. So
// it is enough to watch each body by itself (reportReach); if one goes too far, the step is
// repeated with longer reaches, or with a new list for every move.
#pragma once

#include <limits>

#include "01_naive_collision/naive_collision.cuh"
#include "common/launch.cuh"
#include "common/response.h"

namespace ballpit {

/// A ball's reach is what it would move in `time` with its velocity and the gravity's
/// acceleration, and the share `slack` of its radius for what pushes it; at most what the cells
/// allow.
struct ReachSettings {
    float time;      ///< s
    float gravity;   ///< m/s^2
    float slack;     ///< share of the radius
    float halfCell;  ///< m
};

HD inline float reachOf(float radius, float speed, const ReachSettings& s) {
    const float wanted = s.time * (speed + s.time * s.gravity) + s.slack * radius;
    return minimum(wanted, maximum(s.halfCell - radius, 0.0f));
}

/// Where body i is, with its radius grown by its reach.
HD inline void growByReach(int i, BodiesView bodies, ReachSettings settings, View<Vec4> grown) {
    const Vec4 sphere = bodies.positions[i];
    const float reach = reachOf(sphere.w, length(xyz(bodies.velocities[i])), settings);
    grown[i] = withW(xyz(sphere), sphere.w + reach);
}

//@show reach
/// Tells the host if body i has left its reach.
HD inline void reportReach(int i, BodiesView bodies, View<const Vec4> grown,
                           View<StepStatus> status) {
    const Vec4 sphere = bodies.positions[i];
    const float reach = grown[i].w - sphere.w;
    // Not "farther than": a position that is not a number has left as well.
    const bool within = lengthSquared(xyz(sphere) - xyz(grown[i])) <= reach * reach;
    if (!within) status[0].staleGrid = 1;
}
//@end

/// Counts the pairs that do touch, for the statistics: the list has more.
HD inline void countTouching(int i, View<const Vec4> positions, PairsView pairs,
                             View<StepStatus> status) {
    std::uint32_t touching = 0;
    for (std::uint32_t k = pairs.starts[i]; k < pairs.endOf(i); ++k)
        if (spheresTouch(positions[i], positions[pairs.pairs[k].second])) ++touching;
    if (touching) fetchAdd(status[0].collisions, touching);
}
HD inline void clearTouching(int, View<StepStatus> status) { status[0].collisions = 0; }

/// Nothing bounces off the walls of this world.
inline Bounds noWalls() {
    constexpr float far = std::numeric_limits<float>::max();
    return {{-far, -far, -far}, {far, far, far}};
}

}  // namespace ballpit
