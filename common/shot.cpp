// From a shot's angles to a camera.
#include "common/shot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/camera.h"

namespace ballpit {

namespace {

constexpr float radians = std::numbers::pi_v<float> / 180.0f;
constexpr float steepest = 89.9f;  // at 90, "up" in the picture has no direction

/// The usual view, turned to the angles that were given.
Vec3 directionOf(const Shot& shot) {
    const Vec3 arm = -usualViewDirection;
    const float yaw = shot.yaw ? radians * *shot.yaw : std::atan2(arm.x, arm.z);
    const float pitch = shot.pitch ? radians * std::clamp(*shot.pitch, -steepest, steepest)
                                   : std::asin(arm.y / length(arm));
    return -Vec3{std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw)};
}

}  // namespace

Camera cameraOf(const Shot& shot, Bounds world, float seconds) {
    const bool turned = shot.yaw || shot.pitch;
    Camera camera = frameWorld(world, turned ? directionOf(shot) : usualViewDirection);
    const float angle = radians * seconds * shot.orbit.value_or(0.0f);
    const Vec3 arm = (1.0f / shot.zoom) * (camera.eye - camera.target);
    const float c = std::cos(angle), s = std::sin(angle);
    camera.eye = camera.target + Vec3{c * arm.x + s * arm.z, arm.y, c * arm.z - s * arm.x};
    return camera;
}

}  // namespace ballpit
