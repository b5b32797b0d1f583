// Chapter 08: the camera that a hand moves. It looks at a target from a distance, a yaw and a
// pitch.
#pragma once

#include "common/camera.h"
#include "common/hole.cuh"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ballpit {

/// Seen from the target, the eye stands at this yaw, pitch and distance. Yaw turns to the right: at
/// 0 degrees the eye stands on the z side of the target, at 90 on its x side. Pitch 0 is level with
/// the target, 90 straight above it.
struct OrbitCamera {
    Vec3 target;
    float yaw = 0.0f, pitch = 0.0f;     // degrees
    float distance = 10.0f;             // m
    float verticalFieldOfView = 35.0f;  // degrees

    static constexpr float steepest = 89.0f;  // at 90, "up" in the picture has no direction
    static constexpr float nearest = 1e-3f;   // m

    Vec3 eye() const {
        constexpr float radians = std::numbers::pi_v<float> / 180.0f;
        const float aside = radians * yaw, above = radians * pitch;
        // ---- hole camera.orbit (about 3 lines): Where the eye stands, from the two angles
        TODO_HOLE("camera.orbit");
        return target + Vec3{aside, above, distance};
        // ---- end of camera.orbit
    }

    Camera camera() const { return {eye(), target, {0.0f, 1.0f, 0.0f}, verticalFieldOfView}; }

    /// Walks around the target, by degrees to the right and upwards.
    void orbit(float right, float upwards) {
        yaw += right;
        pitch = std::clamp(pitch + upwards, -steepest, steepest);
    }

    /// Multiplies the distance: below 1 goes nearer.
    void zoom(float factor) { distance = std::max(distance * factor, nearest); }

    /// Moves eye and target together, by metres to the right and upwards as the picture has them.
    void pan(float right, float upwards) {
        const CameraAxes axes = axesOf(camera());
        target += right * axes.right + upwards * axes.up;
    }
};

/// The orbit on which a camera stands.
inline OrbitCamera orbitOf(const Camera& camera) {
    constexpr float degrees = 180.0f / std::numbers::pi_v<float>;
    const Vec3 arm = camera.eye - camera.target;
    return {.target = camera.target,
            .yaw = degrees * std::atan2(arm.x, arm.z),
            .pitch = degrees * std::asin(std::clamp(arm.y / length(arm), -1.0f, 1.0f)),
            .distance = length(arm),
            .verticalFieldOfView = camera.verticalFieldOfView};
}

}  // namespace ballpit
