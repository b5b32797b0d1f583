// The camera, and the matrices that carry a point of the world to a pixel of the frame.
#pragma once

#include "common/vec3.cuh"

#include <array>
#include <optional>

namespace ballpit {

/// A 4x4 matrix as OpenGL stores it, column by column: row r of column c is at [4 * c + r].
using Matrix4 = std::array<float, 16>;

/// Where the picture is taken from. `up` need not be perpendicular to the line of sight.
struct Camera {
    Vec3 eye, target, up{0.0f, 1.0f, 0.0f};
    float verticalFieldOfView = 35.0f;  // degrees
};

/// A camera's own axes in the world, each of length 1 and perpendicular to the others.
struct CameraAxes {
    Vec3 right, up, forward;
};

/// A place in a frame: x to the right and y down from the top-left corner, so that the pixel in
/// column i and row j covers [i, i + 1] x [j, j + 1].
struct PixelPosition {
    float x = 0.0f, y = 0.0f;
};

CameraAxes axesOf(const Camera& camera);

/// Tangent of half the vertical field of view.
float halfHeightTangent(const Camera& camera);

/// Turns a direction by a matrix's upper left 3x3 part.
Vec3 transformDirection(const Matrix4& matrix, Vec3 direction);

/// Where a point of the world falls; nothing if it is behind the eye or outside the frame.
std::optional<PixelPosition> projectToPixel(const Camera& camera, int width, int height,
                                            Vec3 point);

/// A three-quarter view. From this side the axes at world.lower stand at the left, not behind the
/// balls.
inline constexpr Vec3 usualViewDirection{0.50f, -0.36f, -0.79f};

/// A view of the whole box along a direction, as near as a 16:9 frame allows.
Camera frameWorld(Bounds world, Vec3 viewDirection = usualViewDirection);

}  // namespace ballpit
