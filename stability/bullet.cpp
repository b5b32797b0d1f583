// One fast ball, and many in its way.
#include <cmath>

#include "common/random.h"
#include "stability/worlds.h"

namespace ballpit::stability {

namespace {

constexpr float spacing = 1.1f;

void addLattice(Scene& scene, int side, Vec3 corner) {
    for (int k = 0; k < side * side * side; ++k)
        addBall(scene, corner + spacing * Vec3{static_cast<float>(k % side),
                                               static_cast<float>(k / side % side),
                                               static_cast<float>(k / side / side)});
}

}  // namespace

Scene makeBullet(int side, float travel) {
    const float width = spacing * static_cast<float>(side);
    Scene scene = emptyWorld("bullet", {{-6, -6, -6}, {width + 20, width + 6, width + 6}});
    // Along the middle of the balls nearest to the lattice's own middle.
    const float aim = spacing * static_cast<float>(side / 2);
    addBall(scene, {-4.0f, aim + 0.3f * ballRadius, aim}, {travel * ballRadius / scene.dt, 0, 0},
            1.0f, ballRadius, 2.0f);
    addLattice(scene, side, {});
    return scene;
}

Scene makeVolley(int bullets, float travel, std::uint64_t seed) {
    constexpr float lane = 14.0f;  // m: what flies off needs longer than the question takes
    constexpr int side = 3;
    const int lanes = static_cast<int>(std::ceil(std::sqrt(bullets)));
    const float width = lane * static_cast<float>(lanes);
    Scene scene = emptyWorld("bullet", {{-8, -lane, -lane}, {25, width, width}});
    Random random(seed);
    for (int k = 0; k < bullets; ++k) {
        const Vec3 corner{0, lane * static_cast<float>(k % lanes),
                          lane * static_cast<float>(k / lanes)};
        const float off = 0.3f * ballRadius, way = travel * ballRadius;
        const Vec3 aim = random.uniformIn({{-way, -off, -off}, {0, off, off}});
        addBall(scene, corner + Vec3{-2, spacing, spacing} + aim, {way / scene.dt, 0, 0}, 1.0f,
                ballRadius, 2.0f);
        addLattice(scene, side, corner);
    }
    return scene;
}

}  // namespace ballpit::stability
