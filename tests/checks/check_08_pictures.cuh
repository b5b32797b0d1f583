// What chapter 08's checks are made of: pictures by the student's renderer, on black, and how they
// are compared with the ray caster's.
#pragma once

#include <algorithm>
#include <cstdio>
#include <functional>

#include "08_sphere_rendering/sphere_renderer.h"
#include "common/random.h"
#include "tests/checks/check.cuh"
#include "tests/checks/check_08_caster.cuh"

namespace ballpit::check {

constexpr Bounds world08{{-5, -5, -5}, {5, 5, 5}};
constexpr Vec3 red08{1.0f, 0.15f, 0.1f}, green08{0.1f, 0.8f, 0.2f}, blue08{0.15f, 0.3f, 1.0f};

struct View08 {
    Camera camera;
    int width = 320, height = 180;
};

inline Camera cameraAt(Vec3 eye, Vec3 target = {0, 0, 0}, float fieldOfView = 35.0f) {
    return {eye, target, {0, 1, 0}, fieldOfView};
}

/// A picture by a fresh renderer: balls on black, or in their world.
inline Frame drawn(const View08& view, const std::vector<Ball08>& balls, BallShape shape,
                   int slices = 0, bool inWorld = false) {
    SphereRenderer renderer(world08, view.width, view.height);
    renderer.camera = view.camera;
    renderer.style = {.world = inWorld, .shape = shape, .slices = slices};
    std::vector<Vec3> positions, colors;
    std::vector<float> radii;
    for (const Ball08& ball : balls) {
        positions.push_back(ball.position);
        radii.push_back(ball.radius);
        colors.push_back(ball.color);
    }
    renderer.draw(positions, radii, colors);
    return renderer.read();
}

inline const std::uint8_t* pixelOf(const Frame& frame, int x, int y) {
    return &frame.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                           static_cast<std::size_t>(x))];
}

inline bool isBlack(const std::uint8_t* pixel) {
    return std::max({pixel[0], pixel[1], pixel[2]}) < 8;
}

inline std::string colorText(const std::uint8_t* pixel) {
    return "(" + text(int{pixel[0]}) + ", " + text(int{pixel[1]}) + ", " + text(int{pixel[2]}) +
           ")";
}

inline std::array<std::uint8_t, 3> bytesOf(Triple color) {
    const auto byte = [](double c) { return static_cast<std::uint8_t>(std::lround(255 * c)); };
    return {byte(color.x), byte(color.y), byte(color.z)};
}

inline std::string at(int x, int y) {
    return "the pixel " + text(x) + " from the left, " + text(y) + " from the top";
}

/// How near a picture must be to the oracle's: pixels whose neighbours up to `edge` away all see
/// the same ball may differ by `levels` of 255; of the others nothing is asked.
struct Tolerance {
    int edge = 1, levels = 4;
};

/// An oracle's picture, ready to be compared with.
class Expected {
public:
    Expected(const View08& view, const std::vector<Ball08>& balls, Twist twist = {})
        : width_(view.width),
          height_(view.height),
          seen_(RayCaster(view.camera, view.width, view.height, balls, twist).picture()) {}

    const Seen& seen(int x, int y) const {
        return seen_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(x)];
    }

    /// Calls visit(x, y) for each pixel that must be right.
    void forEachSure(int edge, const std::function<void(int, int)>& visit) const {
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x)
                if (isSure(x, y, edge)) visit(x, y);
    }

    bool isRight(const Frame& frame, int x, int y, int levels) const {
        const auto right = bytesOf(seen(x, y).color);
        const std::uint8_t* got = pixelOf(frame, x, y);
        for (std::size_t channel = 0; channel < 3; ++channel)
            if (std::abs(int{got[channel]} - int{right[channel]}) > levels) return false;
        return true;
    }

    /// The share of sure pixels that are right, of those that either picture has a ball in.
    double agreement(const Frame& frame, Tolerance tolerance) const {
        int right = 0, all = 0;
        forEachSure(tolerance.edge, [&](int x, int y) {
            if (seen(x, y).ball == nobody && isBlack(pixelOf(frame, x, y))) return;
            ++all;
            right += isRight(frame, x, y, tolerance.levels);
        });
        return all == 0 ? 0.0 : static_cast<double>(right) / all;
    }

private:
    bool isSure(int x, int y, int edge) const {
        if (std::min(x, y) < edge || x + edge >= width_ || y + edge >= height_) return false;
        const int own = seen(x, y).ball;
        for (int v = y - edge; v <= y + edge; ++v)
            for (int u = x - edge; u <= x + edge; ++u)
                if (seen(u, v).ball != own) return false;
        return true;
    }

    int width_, height_;
    std::vector<Seen> seen_;
};

// ---- the picture of a failure: yours, the oracle's, and wrong pixels in red

inline Frame threeFrames(const Frame& got, const Expected& expected, Tolerance tolerance) {
    constexpr int gap = 6;
    Frame sheet{3 * got.width + 2 * gap, got.height, {}};
    sheet.rgb.assign(
        3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height), 255);
    const auto put = [&](int column, int x, int y, std::array<std::uint8_t, 3> color) {
        const int left = column * (got.width + gap) + x;
        std::copy(color.begin(), color.end(),
                  sheet.rgb.begin() + (pixelOf(sheet, left, y) - sheet.rgb.data()));
    };
    for (int y = 0; y < got.height; ++y)
        for (int x = 0; x < got.width; ++x) {
            const std::uint8_t* pixel = pixelOf(got, x, y);
            put(0, x, y, {pixel[0], pixel[1], pixel[2]});
            put(1, x, y, bytesOf(expected.seen(x, y).color));
            put(2, x, y, {235, 235, 238});
        }
    expected.forEachSure(tolerance.edge, [&](int x, int y) {
        if (!expected.isRight(got, x, y, tolerance.levels)) put(2, x, y, {220, 38, 33});
    });
    return sheet;
}

// ---- comparing

inline std::vector<Mistake> pictureMistakes(const View08& view, const std::vector<Ball08>& balls,
                                            const Frame& got, Tolerance tolerance) {
    const auto looks = [=](Twist twist) {
        return [=] { return Expected(view, balls, twist).agreement(got, tolerance) > 0.9; };
    };
    const auto empty = [=] {
        for (int y = 0; y < got.height; ++y)
            for (int x = 0; x < got.width; ++x)
                if (!isBlack(pixelOf(got, x, y))) return false;
        return true;
    };
    return {{"an empty picture", empty},
            {"upside down", looks({.upsideDown = true})},
            {"left and right exchanged", looks({.leftRight = true})},
            {"the diameter taken for the radius", looks({.radiusFactor = 2})},
            {"half the radius", looks({.radiusFactor = 0.5})},
            {"the far side of the balls", looks({.farSide = true})},
            {"normals that point into the ball", looks({.normalInward = true})},
            {"every normal facing the eye", looks({.normalToEye = true})},
            {"no depth test: the ball drawn last is seen", looks({.lastDrawn = true})},
            {"the depth of centres, not of surfaces", looks({.centerDepth = true})}};
}

/// Every sure pixel must be the oracle's. `name` tells pictures apart in messages.
inline void requirePicture(Report& report, const std::string& name, const View08& view,
                           const std::vector<Ball08>& balls, const Frame& got,
                           Tolerance tolerance) {
    const Expected expected(view, balls);
    expected.forEachSure(tolerance.edge, [&](int x, int y) {
        if (expected.isRight(got, x, y, tolerance.levels)) return;
        const auto right = bytesOf(expected.seen(x, y).color);
        report.fail(name + ": " + at(x, y), colorText(pixelOf(got, x, y)), colorText(right.data()));
    });
    if (!report.failed()) return;
    report.guess(pictureMistakes(view, balls, got, tolerance));
    report.picture([&] { return threeFrames(got, expected, tolerance); });
}

/// Balls at random places before the eye, some of which cut each other.
inline std::vector<Ball08> scattered08(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<Ball08> balls;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 place = random.uniformIn({{-4, -2, -3}, {4, 2, 3}});
        balls.push_back({place, random.uniform(0.15f, 1.0f),
                         random.uniformIn({{0.2f, 0.2f, 0.2f}, {1, 1, 1}})});
    }
    return balls;
}

}  // namespace ballpit::check
