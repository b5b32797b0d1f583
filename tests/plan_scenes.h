// Scenes that lie beside one threshold of the plan, where no charted scene does.
#pragma once

#include "common/random.h"
#include "stability/scenes.h"
#include "tests/support.h"

namespace ballpit::test {

/// Dull balls (r 0.5 m) on a lattice in a box without room to the sides, each overlapping its
/// neighbours by `overlap` radii.
inline Scene pressedLattice(float overlap) {
    constexpr int side = 6, layers = 13;
    const float spacing = 1.0f - 0.5f * overlap, width = spacing * (side - 1) + 1.0f;
    Scene scene{"pressed",
                {},
                {{0, 0, 0}, {width, spacing * layers + 6.0f, width}},
                1.25f,
                {0, -9.81f, 0},
                0.0f,
                1.0f / 60.0f};
    for (int k = 0; k < side * side * layers; ++k) {
        const Vec3 place{static_cast<float>(k % side), static_cast<float>(k / side / side),
                         static_cast<float>(k / side % side)};
        scene.spheres.add(Vec3{0.5f, 0.5f, 0.5f} + spacing * place, {}, 0.5f, 1.0f, 0.3f);
    }
    return scene;
}

/// `count` elastic balls (r 0.1 m) at random 3 to 5 m above a floor 1.26 m wide.
inline Scene elasticRain(int count, std::uint64_t seed) {
    Scene scene = stability::makeSixCubed(1.0f, 1);
    scene.spheres = {};
    scene.bounds.upper.y = 5.2f;
    const Bounds sky{{scene.bounds.lower.x, 3, scene.bounds.lower.z},
                     {scene.bounds.upper.x, 5, scene.bounds.upper.z}};
    const std::vector<float> radii(static_cast<std::size_t>(count), 0.1f);
    for (const Vec3 place : nonOverlappingPositions(radii, sky, seed))
        scene.spheres.add(place, {}, 0.1f, 10.0f, 1.0f);
    return scene;
}

/// static_overlap, `scale` times as wide: fewer contacts a ball.
inline Scene looserCrowd(float scale) {
    Scene scene = makeScene("static_overlap", 2000, 1);
    for (Vec3& place : scene.spheres.positions) place = scale * place;
    return scene;
}

/// A block of dull balls, 4 by 4 by 20, in the middle of a wide floor: it falls apart.
inline Scene towerBlock() {
    Scene scene{"tower", {},          {{-20, 0, -20}, {20, 30, 20}}, 1.25f, {0, -9.81f, 0},
                0.0f,    1.0f / 60.0f};
    Random random(3);
    for (int k = 0; k < 4 * 4 * 20; ++k)
        scene.spheres.add(Vec3{-1.6f + 1.05f * static_cast<float>(k % 4),
                               0.55f + 1.05f * static_cast<float>(k / 16),
                               -1.6f + 1.05f * static_cast<float>(k / 4 % 4)} +
                              random.uniformIn({{-0.02f, -0.02f, -0.02f}, {0.02f, 0.02f, 0.02f}}),
                          {}, 0.5f, 1.0f, 0.3f);
    return scene;
}

}  // namespace ballpit::test
