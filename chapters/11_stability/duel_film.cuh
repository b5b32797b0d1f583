// The film of a duel: both sides next to each other, step by step.
#pragma once

#include "chapters/11_stability/duel.cuh"
#include "common/coloring.h"
#include "common/film.h"
#include "common/host_pairs.h"
#include "common/progress.h"

namespace ballpit {

/// With gravity, one colour a ball by how deep it sticks in another: grey to half a radius.
inline std::vector<Vec3> colorsByOverlap(const Spheres& balls) {
    constexpr float reddest = 6.0f;  // contactColor's last
    std::vector<float> depths(balls.count(), 0.0f);
    for (const auto [a, b] : findPairsOnHost(balls)) {
        const float reach = balls.radii[a] + balls.radii[b];
        const float depth = reach - length(balls.positions[a] - balls.positions[b]);
        for (const std::uint32_t k : {a, b}) depths[k] = std::max(depths[k], depth);
    }
    std::vector<Vec3> colors;
    for (std::size_t k = 0; k < balls.count(); ++k)
        colors.push_back(
            contactColor(static_cast<std::size_t>(reddest * depths[k] / (0.5f * balls.radii[k]))));
    return colors;
}

/// m/s: of the fastest ball.
inline float topSpeed(const Spheres& balls) {
    float speed = 1e-6f;
    for (const Vec3 v : balls.velocities) speed = std::max(speed, length(v));
    return speed;
}

/// The colours tell what the duel is about: overlaps where balls rest, speed where they fly.
inline std::vector<Vec3> duelColors(const Scene& scene, const Spheres& balls) {
    if (scene.gravity.y != 0) return colorsByOverlap(balls);
    return colorsBy(ColorBy::speed, {.balls = balls, .topSpeed = topSpeed(scene.spheres)});
}

/// The balls of both sides, the first side moved left and the second right.
inline Spheres sideBySide(Match& match, Vec3 shift) {
    Spheres both;
    for (Side& side : match.sides) {
        const Spheres balls = side.balls();
        const std::vector<Vec3> colors = duelColors(match.scene, balls);
        const Vec3 moved = &side == match.sides ? -shift : shift;
        for (std::size_t k = 0; k < balls.count(); ++k)
            both.add(balls.positions[k] + moved, {}, balls.radii[k], 1.0f, 1.0f, colors[k]);
    }
    return both;
}

/// Films as many steps as the options say, or takes a picture of the last. From the front, unless
/// the options say otherwise.
inline void filmDuel(const Duel& duel, Options options) {
    Match match(duel, options);
    const bool showsAll = extent(duel.view).x == 0.0f;
    const Bounds box = showsAll ? match.scene.bounds : duel.view;
    const Vec3 shift{0.55f * (box.upper.x - box.lower.x), 0, 0};
    if (!options.shot.yaw) options.shot.yaw = 0.0f;
    Film film(options, {box.lower - shift, box.upper + shift});
    const std::string names =
        duel.scene + ": " + match.sides[0].methodName() + " | " + match.sides[1].methodName();
    const StopRequest stop;
    for (int frame = 1; frame <= options.frames && !StopRequest::received(); ++frame) {
        if (frame % duel.framesAStep == 0) match.step();
        if (!options.isFilmed() && frame < options.frames) continue;
        const Spheres both = sideBySide(match, shift);
        film.capture(both.positions, both.radii, both.colors, names);
    }
    film.finish();
}

}  // namespace ballpit
