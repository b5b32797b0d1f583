// What chapter 08's executable shows: pictures side by side, what they need, and what they cost.
#pragma once

#include <GL/glew.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "08_sphere_rendering/detail.h"
#include "08_sphere_rendering/orbit_camera.h"
#include "08_sphere_rendering/sphere_renderer.h"
#include "common/findings.h"
#include "common/offscreen_context.h"
#include "common/options.h"
#include "common/scene.h"
#include "common/timing.h"

namespace ballpit {

/// A few balls that are large on the screen, and some behind them that are small.
inline Spheres fewBalls() {
    Spheres few;
    const auto add = [&](Vec3 place, float radius) {
        few.add(place, {}, radius, 1.0f, 1.0f, paletteColor(few.count()));
    };
    add({-1.1f, 1.0f, 0.9f}, 1.0f);
    add({1.0f, 0.7f, 1.3f}, 0.7f);
    add({0.4f, 1.6f, -1.0f}, 0.9f);
    add({0.1f, 0.4f, 2.2f}, 0.4f);
    for (int k = 0; k < 12; ++k) {
        const auto turn = static_cast<float>(k);
        add({-2.6f + 0.47f * turn, 0.2f + 0.12f * turn, -2.4f}, 0.13f + 0.012f * turn);
    }
    return few;
}

constexpr Bounds fewBallsWorld{{-3, 0, -3}, {3, 4, 3}};

inline Frame drawn(SphereRenderer& renderer, const Spheres& balls, BallShape shape, int slices) {
    renderer.style.shape = shape;
    renderer.style.slices = slices;
    renderer.draw(balls.positions, balls.radii, balls.colors);
    return renderer.read();
}

/// Frames of one size in a row.
inline Frame inARow(const std::vector<Frame>& frames) {
    Frame row{0, frames[0].height, {}};
    for (const Frame& frame : frames) row.width += frame.width;
    for (int y = 0; y < row.height; ++y)
        for (const Frame& frame : frames) {
            const auto bytes = std::ptrdiff_t{3} * frame.width;
            const auto line = frame.rgb.begin() + y * bytes;
            row.rgb.insert(row.rgb.end(), line, line + bytes);
        }
    return row;
}

/// How much two frames differ, eight times as strong, dark on white.
inline Frame difference(const Frame& a, const Frame& b) {
    Frame shown{a.width, a.height, {}};
    for (std::size_t k = 0; k < a.rgb.size(); ++k)
        shown.rgb.push_back(
            static_cast<std::uint8_t>(255 - std::min(255, 8 * std::abs(a.rgb[k] - b.rgb[k]))));
    return shown;
}

/// The few balls as GLU spheres, as impostors, and where the two pictures differ.
inline Frame sideBySide(const Options& o) {
    const OffscreenContext context;
    SphereRenderer renderer(fewBallsWorld, o.width / 3, o.height);
    OrbitCamera orbit = orbitOf(frameWorld(fewBallsWorld));
    orbit.zoom(0.8f);
    renderer.camera = orbit.camera();
    const Spheres balls = fewBalls();
    const Frame nets = drawn(renderer, balls, BallShape::gluSpheres, 0);
    const Frame exact = drawn(renderer, balls, BallShape::impostors, 0);
    return inARow({nets, exact, difference(nets, exact)});
}

/// How large the balls appear, and how many faces they need.
inline void tellDetail(Findings& findings, const Spheres& balls, const Camera& camera, int height) {
    float smallest = 1e9f, largest = 0.0f;
    std::int64_t faces = 0;
    for (std::size_t k = 0; k < balls.count(); ++k) {
        const float pixels = pixelRadius(camera, height, balls.positions[k], balls.radii[k]);
        smallest = std::min(smallest, pixels);
        largest = std::max(largest, pixels);
        faces += std::int64_t{slicesFor(pixels)} * (slicesFor(pixels) / 2);
    }
    const auto rounded = [](float pixels) { return 0.1 * std::round(10.0 * double(pixels)); };
    findings.add("smallest radius, pixels", rounded(smallest));
    findings.add("largest radius, pixels", rounded(largest));
    findings.add("slices for the smallest", std::int64_t{slicesFor(smallest)});
    findings.add("slices for the largest", std::int64_t{slicesFor(largest)});
    findings.add("faces, chosen by size", faces);
    findings.add("faces, 32 x 32 a ball", std::int64_t(balls.count()) * 32 * 32);
}

/// For figures: where the eye of an orbit stands, and slices for radii from 1 to 256 pixels.
inline void listForFigures(Findings& findings) {
    std::vector<Vec3> eyes;
    for (const float yaw : {0.0f, 30.0f, 60.0f, 90.0f})
        for (const float pitch : {0.0f, 30.0f})
            eyes.push_back(OrbitCamera{.yaw = yaw, .pitch = pitch, .distance = 2.0f}.eye());
    findings.list("eyes", eyes);
    std::vector<double> radii, slices;
    for (float radius = 1.0f; radius <= 256.0f; radius *= 2.0f) {
        radii.push_back(double(radius));
        slices.push_back(slicesFor(radius));
    }
    findings.list("radii", radii);
    findings.list("slices", slices);
}

/// The time of a frame drawn in each way, without reading it back: medians in ms.
class Race {
public:
    Race(const Options& o, const Scene& scene)
        : renderer_(scene.bounds, o.width, o.height), balls_(scene.spheres) {}

    void run(Findings& findings) {
        const auto draw = [&] { renderer_.draw(balls_.positions, balls_.radii, balls_.colors); };
        time(findings, "milliseconds", BallShape::impostors, 7, draw);
        time(findings, "points: milliseconds", BallShape::points, 7, draw);
        const float largest = fillBuffer();
        time(findings, "points in place: milliseconds", BallShape::points, 7,
             [&] { renderer_.drawFromBuffer(largest); });
        if (balls_.count() > 20'000) return;  // nets would take seconds a frame
        time(findings, "GLU by size: milliseconds", BallShape::gluSpheres, 3, draw);
        time(findings, "GLU 32 x 32: milliseconds", BallShape::gluSpheres, 1, draw, 32);
    }

private:
    /// Puts the balls where a kernel would write them; returns the largest radius.
    float fillBuffer() {
        std::vector<Vec4> packed;
        for (std::size_t k = 0; k < balls_.count(); ++k)
            packed.push_back(withW(balls_.positions[k], balls_.radii[k]));
        glBindBuffer(GL_ARRAY_BUFFER, renderer_.positionBuffer(packed.size()));
        glBufferSubData(GL_ARRAY_BUFFER, 0, GLsizeiptr(packed.size() * sizeof(Vec4)),
                        packed.data());
        glBindBuffer(GL_ARRAY_BUFFER, 0);
        renderer_.setColors(balls_.colors);
        return *std::max_element(balls_.radii.begin(), balls_.radii.end());
    }

    template <class Draw>
    void time(Findings& findings, const char* name, BallShape shape, int repeats, Draw draw,
              int slices = 0) {
        renderer_.style.shape = shape;
        renderer_.style.slices = slices;
        findings.add(name, medianMilliseconds(Device::cpu, repeats, [&] {
                         draw();
                         renderer_.finish();
                     }));
    }

    SphereRenderer renderer_;
    const Spheres& balls_;
};

inline void tellTimes(Findings& findings, const Options& o, const Scene& scene) {
    const OffscreenContext context;
    Race(o, scene).run(findings);
}

}  // namespace ballpit
