// How the bodies lie in memory, as kernels see them.
#pragma once

#include <cstdint>

#include "common/buffer.cuh"
#include "common/vec3.cuh"

namespace ballpit {

/// The bodies in memory order ("slots"). The engine keeps them in cell order, so slot i holds a
/// different body after every sort; ids[i] says which one.
struct BodiesView {
    View<Vec4> positions;      ///< x, y, z in m; w: radius in m
    View<Vec4> velocities;     ///< x, y, z in m/s; w: 1 / mass in 1/kg
    View<float> restitutions;  ///< 0 (dead stop) to 1 (elastic)
    View<std::uint32_t> ids;   ///< the body's number as the user knows it
    Vec4 period{};             ///< x, y, z in m: edges of a periodic box; 0 between walls
};

/// In a box with these edges that goes on where it ends, each body has an image one edge further,
/// on every side. `between` leads from one body in the box to another; what is returned leads to
/// that one's nearest image.
template <class Number>
HD Number toNearestImage(Number between, Number period) {
    const Number half = Number(0.5) * period;
    if (between > half) return between - period;
    return between < -half ? between + period : between;
}
HD inline Vec3 toNearestImage(Vec3 between, Vec3 period) {
    return {toNearestImage(between.x, period.x), toNearestImage(between.y, period.y),
            toNearestImage(between.z, period.z)};
}

/// From the centre in slot a to the one in slot b, m. (In a periodic box of chapter 11: to the
/// nearest image of b.)
HD inline Vec3 betweenCentres(std::uint32_t a, std::uint32_t b, const BodiesView& bodies) {
    const Vec3 between = xyz(bodies.positions[b]) - xyz(bodies.positions[a]);
    if (bodies.period.x > 0.0f) [[unlikely]]
        return toNearestImage(between, xyz(bodies.period));
    return between;
}

/// What a step must tell the host. Lives on the device; zero (noBody for the ids) at step start.
struct StepStatus {
    std::uint32_t roundsDetected;         ///< rounds whose pairs are listed so far
    std::uint32_t collisions;             ///< touching pairs found in the first round
    std::uint32_t pairsNeeded;            ///< the most pairs a round found, stored or not
    std::uint32_t pairsUncountable;       ///< 1 if a round found more pairs than 32 bits count
    std::uint32_t outside;                ///< bodies whose centre was outside the grid when hashed
    std::uint32_t staleGrid;              ///< 1 if a body moved too far for the grid it is in
    std::uint32_t notFiniteAfterMoving;   ///< smallest id not finite after integrate, or noBody
    std::uint32_t notFiniteAfterImpulse;  ///< the same after collisionResponse
};

constexpr std::uint32_t noBody = 0xFFFFFFFFu;

}  // namespace ballpit
