// One fast ball, and many in its way.
#include "stability/worlds.h"

namespace ballpit::stability {

Scene makeBullet(int side, float travel) {
    constexpr float spacing = 1.1f;
    const float width = spacing * static_cast<float>(side);
    Scene scene = emptyWorld("bullet", {{-6, -6, -6}, {width + 20, width + 6, width + 6}});
    // Along the middle of the balls nearest to the lattice's own middle.
    const float aim = spacing * static_cast<float>(side / 2);
    addBall(scene, {-4.0f, aim + 0.3f * ballRadius, aim}, {travel * ballRadius / scene.dt, 0, 0},
            1.0f, ballRadius, 2.0f);
    for (int k = 0; k < side * side * side; ++k)
        addBall(scene,
                spacing * Vec3{static_cast<float>(k % side), static_cast<float>(k / side % side),
                               static_cast<float>(k / side / side)});
    return scene;
}

}  // namespace ballpit::stability
