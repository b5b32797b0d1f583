// What tests of pictures are made of: balls, cameras, and questions to pixels.
#pragma once

#include "08_sphere_rendering/sphere_renderer.h"
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ballpit {

constexpr Bounds world{{-5.0f, -5.0f, -5.0f}, {5.0f, 5.0f, 5.0f}};
constexpr Vec3 red{1.0f, 0.1f, 0.1f}, green{0.1f, 1.0f, 0.1f}, blue{0.1f, 0.1f, 1.0f};
constexpr Vec3 magenta{1.0f, 0.1f, 1.0f};

struct Ball {
    Vec3 position;
    float radius;
    Vec3 color;
};

/// Draws on a fresh renderer, so that no picture depends on the one before.
inline Frame render(const Camera& camera, int width, int height, const std::vector<Ball>& balls,
                    const DrawStyle& style = {}) {
    SphereRenderer renderer(world, width, height);
    renderer.camera = camera;
    renderer.style = style;
    std::vector<Vec3> positions, colors;
    std::vector<float> radii;
    for (const Ball& ball : balls) {
        positions.push_back(ball.position);
        radii.push_back(ball.radius);
        colors.push_back(ball.color);
    }
    renderer.draw(positions, radii, colors);
    return renderer.read();
}

/// Looks at the world's centre from the front: x to the right, y up.
inline Camera frontCamera() {
    Camera camera;
    camera.eye = {0.0f, 0.0f, 20.0f};
    return camera;
}

/// Compared here and not in a CHECK, which would print all bytes.
inline bool same(const Frame& a, const Frame& b) {
    return a.width == b.width && a.height == b.height && a.rgb == b.rgb;
}

inline std::size_t byteIndex(const Frame& frame, int column, int row) {
    return 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width) +
                static_cast<std::size_t>(column));
}

/// A pixel's colour in [0, 1].
inline Vec3 colorAt(const Frame& frame, PixelPosition place) {
    const auto* pixel =
        &frame.rgb[byteIndex(frame, static_cast<int>(place.x), static_cast<int>(place.y))];
    return Vec3{float(pixel[0]), float(pixel[1]), float(pixel[2])} / 255.0f;
}

/// The pixel's colour where a point of the world falls, which must be inside the frame.
inline Vec3 colorWhere(const Frame& frame, const Camera& camera, Vec3 point) {
    const auto place = projectToPixel(camera, frame.width, frame.height, point);
    REQUIRE(place.has_value());
    return colorAt(frame, *place);
}

/// 'r', 'g' or 'b' if that channel is clearly above both others, else '-'.
inline char hue(Vec3 c) {
    if (c.x > 1.5f * std::max(c.y, c.z)) return 'r';
    if (c.y > 1.5f * std::max(c.x, c.z)) return 'g';
    if (c.z > 1.5f * std::max(c.x, c.y)) return 'b';
    return '-';
}

struct Extent {
    float left = 1e9f, right = -1e9f, top = 1e9f, bottom = -1e9f;

    void include(float x, float y) {
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
    }
};

/// The extent of a scene's magenta balls, to the pixels that they cover by about a half.
inline Extent ballExtent(const Camera& camera, int width, int height,
                         const std::vector<Ball>& balls) {
    const Frame frame = render(camera, width, height, balls);
    const Frame empty = render(camera, width, height, {});
    Extent extent;
    for (int row = 0; row < frame.height; ++row)
        for (int column = 0; column < frame.width; ++column) {
            const auto x = static_cast<float>(column), y = static_cast<float>(row);
            const Vec3 color = colorAt(frame, {x, y});
            // Where the axes meet, they too are magenta.
            if (color == colorAt(empty, {x, y})) continue;
            if (std::min(color.x, color.z) < 1.3f * color.y) continue;
            extent.include(x, y);
            extent.include(x + 1.0f, y + 1.0f);
        }
    return extent;
}

inline Vec3 unit(Vec3 a) { return a / length(a); }

/// Where sight just touches the ball is a circle: its extent in the picture.
inline Extent silhouetteExtent(const Camera& camera, int width, int height, const Ball& ball) {
    const Vec3 toEye = camera.eye - ball.position;
    const float ratio = ball.radius * ball.radius / lengthSquared(toEye);
    const Vec3 center = ball.position + ratio * toEye;
    const float radius = ball.radius * std::sqrt(1.0f - ratio);
    const Vec3 a = unit(cross(toEye, {0.3f, 1.0f, 0.2f})), b = unit(cross(toEye, a));
    Extent extent;
    for (int degree = 0; degree < 360; ++degree) {
        const float angle = static_cast<float>(degree) * std::numbers::pi_v<float> / 180.0f;
        const Vec3 point = center + radius * (std::cos(angle) * a + std::sin(angle) * b);
        const auto pixel = projectToPixel(camera, width, height, point);
        REQUIRE(pixel.has_value());
        extent.include(pixel->x, pixel->y);
    }
    return extent;
}

}  // namespace ballpit
