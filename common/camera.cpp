// Camera matrices, and the view that fits a box into the frame.
#include "common/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ballpit {
namespace {

Vec3 normalize(Vec3 a) { return a / length(a); }

/// Corner i of a box: bits 0, 1 and 2 of i choose the upper end along x, y and z.
Vec3 corner(Bounds box, int i) {
    return {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
            i & 4 ? box.upper.z : box.lower.z};
}

/// How far an eye must stand back, and aside, for a box to fill the frame along one axis.
struct Fit {
    float aside, forward;
};

/// The eye at (aside a, forward f) sees a corner at (s, d) if |s - a| <= t (d - f), t being the
/// tangent of half the field of view. So a - t f >= s - t d and -a - t f >= -s - t d for all
/// corners; the nearest eye makes both equal at the outermost corners.
Fit fitAxis(Bounds box, Vec3 side, Vec3 forward, float tangent) {
    float plus = -std::numeric_limits<float>::infinity(), minus = plus;
    for (int i = 0; i < 8; ++i) {
        const float s = dot(corner(box, i), side), d = dot(corner(box, i), forward);
        plus = std::max(plus, s - tangent * d);
        minus = std::max(minus, -s - tangent * d);
    }
    return {0.5f * (plus - minus), -0.5f * (plus + minus) / tangent};
}

}  // namespace

CameraAxes axesOf(const Camera& camera) {
    const Vec3 forward = normalize(camera.target - camera.eye);
    const Vec3 right = normalize(cross(forward, camera.up));
    return {right, cross(right, forward), forward};
}

float halfHeightTangent(const Camera& camera) {
    return std::tan(camera.verticalFieldOfView * std::numbers::pi_v<float> / 360.0f);
}

Vec3 transformDirection(const Matrix4& m, Vec3 d) {
    return {m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
            m[2] * d.x + m[6] * d.y + m[10] * d.z};
}

std::optional<PixelPosition> projectToPixel(const Camera& camera, int width, int height,
                                            Vec3 point) {
    const auto [right, up, forward] = axesOf(camera);
    const Vec3 fromEye = point - camera.eye;
    const float depth = dot(fromEye, forward);
    if (!(depth > 0.0f)) return std::nullopt;
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    const float pixelsPerTangent = 0.5f * h / halfHeightTangent(camera);
    const PixelPosition pixel{0.5f * w + pixelsPerTangent * dot(fromEye, right) / depth,
                              0.5f * h - pixelsPerTangent * dot(fromEye, up) / depth};
    const bool inside = pixel.x >= 0.0f && pixel.x < w && pixel.y >= 0.0f && pixel.y < h;
    return inside ? std::optional(pixel) : std::nullopt;
}

Camera frameWorld(Bounds world, Vec3 viewDirection) {
    constexpr float aspect = 16.0f / 9.0f, margin = 1.06f;
    Camera camera;
    camera.target = viewDirection;
    const auto [right, up, forward] = axesOf(camera);
    const float tangent = halfHeightTangent(camera) / margin;
    const Fit across = fitAxis(world, right, forward, tangent * aspect);
    const Fit along = fitAxis(world, up, forward, tangent);

    const float nearest = std::min(across.forward, along.forward);
    camera.eye = across.aside * right + along.aside * up + nearest * forward;
    const Vec3 center = 0.5f * (world.lower + world.upper);
    camera.target = camera.eye + dot(center - camera.eye, forward) * forward;
    return camera;
}

}  // namespace ballpit
