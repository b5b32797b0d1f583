// Scenes of a few balls, each made to show one thing in motion.
#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/random.h"
#include "common/scene.h"

namespace ballpit {

namespace {

constexpr float radius = 0.5f, mass = 1.0f, cellSize = 1.2f;

Scene emptyRoom(const char* name, Bounds bounds) {
    return {name, {}, bounds, cellSize, {0, 0, 0}, 0.0f, 1.0f / 60.0f};
}

/// From `first` to `last` in `count` equal steps, the k-th of them.
float between(float first, float last, int k, int count) {
    return count < 2
               ? first
               : first + (last - first) * static_cast<float>(k) / static_cast<float>(count - 1);
}

}  // namespace

Scene makeHeadOn(int count, std::uint64_t) {
    constexpr float spacing = 1.5f, speed = 3.0f;
    constexpr Vec3 runner{0.90f, 0.30f, 0.24f}, target{0.24f, 0.52f, 0.86f};
    const int lanes = (count + 1) / 2;
    const float half = 0.5f * spacing * static_cast<float>(lanes);
    Scene scene = emptyRoom("head_on", {{-6, 0, -half}, {6, 2, half}});
    for (int k = 0; k < count; ++k) {
        const int lane = k / 2;
        const bool runs = k % 2 == 0;
        const float z = half - spacing * (0.5f + static_cast<float>(lane));
        scene.spheres.add({runs ? -5.0f : 0.0f, radius, z}, {runs ? speed : 0.0f, 0, 0}, radius,
                          mass, between(0.0f, 1.0f, lane, lanes), runs ? runner : target);
    }
    return scene;
}

Scene makeStaticOverlap(int count, std::uint64_t seed) {
    // As dense as 64 balls in a cube of 2 m: every ball in dozens of others.
    const float side = static_cast<float>(0.5 * std::cbrt(double(count)));
    const float room = 2.0f * side + 2.0f;
    Scene scene = emptyRoom("static_overlap", {{-room, -room, -room}, {room, room, room}});
    Random random(seed);
    const Vec3 corner{0.5f * side, 0.5f * side, 0.5f * side};
    for (int k = 0; k < count; ++k)
        scene.spheres.add(random.uniformIn({-corner, corner}), {}, radius, mass, 0.5f,
                          paletteColor(static_cast<std::size_t>(k)));
    return scene;
}

Scene makeFallingBalls(int count, std::uint64_t) {
    constexpr float spacing = 1.5f, height = 6.0f;
    const float half = 0.5f * spacing * static_cast<float>(count);
    Scene scene = emptyRoom("falling_balls", {{-half, 0, -1.5f}, {half, height + 1.5f, 1.5f}});
    scene.gravity = {0, -9.81f, 0};
    for (int k = 0; k < count; ++k)
        scene.spheres.add({-half + spacing * (0.5f + static_cast<float>(k)), height, 0}, {}, radius,
                          mass, between(0.0f, 1.0f, k, count),
                          paletteColor(static_cast<std::size_t>(k)));
    return scene;
}

Scene makeBreak(int count, std::uint64_t) {
    // Rows of 1, 2, 3, ... balls: a triangle whose tip points at the one that comes. A hair nearer
    // than touching, so that all contacts are there from the start.
    constexpr float spacing = 0.998f, rowDistance = 0.8660254f * spacing, speed = 6.0f;
    int rows = 1;
    while (rows * (rows + 1) / 2 < count - 1) ++rows;
    const float half = 0.8f * static_cast<float>(rows) + 1.5f;
    Scene scene = emptyRoom("break", {{-1.25f * half, 0, -half}, {1.25f * half, 1.0f, half}});
    scene.spheres.add({-half, radius, 0}, {speed, 0, 0}, radius, mass, 1.0f, {0.97f, 0.97f, 0.97f});
    for (int row = 0; row < rows; ++row)
        for (int k = 0; k <= row && static_cast<int>(scene.spheres.count()) < count; ++k) {
            const float across = spacing * (static_cast<float>(k) - 0.5f * static_cast<float>(row));
            scene.spheres.add({rowDistance * static_cast<float>(row), radius, across}, {}, radius,
                              mass, 1.0f, paletteColor(scene.spheres.count()));
        }
    return scene;
}

}  // namespace ballpit
