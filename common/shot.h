// Where the camera of a film stands, and how it moves.
#pragma once

#include <optional>

#include "common/vec3.cuh"

namespace ballpit {

struct Camera;

/// What is not given is as usual: the whole world from the front left, and a little from above.
struct Shot {
    std::optional<float> yaw;    ///< degrees around the world: 0 its front, 90 its right side
    std::optional<float> pitch;  ///< degrees: 0 level, 90 from above
    float zoom = 1.0f;           ///< 2: half as far away
    std::optional<float> orbit;  ///< degrees a second around the world, to the right
};

/// The camera `seconds` after the film's start.
Camera cameraOf(const Shot& shot, Bounds world, float seconds);

}  // namespace ballpit
