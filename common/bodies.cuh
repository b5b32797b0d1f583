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
};

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
