// Chapter 08: how finely a ball must be divided, from its size on the screen.
#pragma once

#include "common/camera.h"
#include "common/hole.cuh"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ballpit {

/// How large a ball appears: its radius in pixels, in a frame of this height. Its size shrinks with
/// its depth, which is measured along the line of sight. A ball that reaches the eye fills the
/// frame.
inline float pixelRadius(const Camera& camera, int height, Vec3 position, float radius) {
    const float depth = dot(position - camera.eye, axesOf(camera).forward);
    const auto pixels = static_cast<float>(height);
    if (depth <= radius) return pixels;
    // ---- hole size.radius (about 2 lines): How many pixels high is the frame in metres, at that depth?
    TODO_HOLE("size.radius");
    return radius;
    // ---- end of size.radius
}

/// The fewest slices with which the outline is nowhere more than half a pixel wrong: the middle of
/// an edge lies R (1 - cos(pi / slices)) inside a circle of R pixels. Even, and at least 6.
inline int slicesFor(float pixelRadius) {
    constexpr float tolerance = 0.5f;  // pixels
    if (pixelRadius <= tolerance) return 6;
    // ---- hole size.slices (about 3 lines): Solve the error for the number of slices; round up to even
    TODO_HOLE("size.slices");
    return 6;
    // ---- end of size.slices
}

}  // namespace ballpit
