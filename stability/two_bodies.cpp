// The scene of a single collision.
#include <cmath>

#include "stability/worlds.h"

namespace ballpit::stability {

Scene makeTwoBodies(const TwoBodies& k) {
    constexpr float sigma = 2.0f * ballRadius;
    Scene scene = emptyWorld("two_bodies", {{-20, -20, -20}, {20, 20, 20}});
    scene.cellSize = 5.0f;                    // two balls need no fine grid
    const float way = k.travel * ballRadius;  // m a step
    // The balls touch at the distance sigma; one step before, and `phase` of one, it is too far.
    const float touching = sigma * std::sqrt(1.0f - k.offset * k.offset);
    const float start = touching + (1.0f - k.phase) * way;
    addBall(scene, {-start, k.offset * sigma, 0}, {way / scene.dt, 0, 0}, k.restitution);
    addBall(scene, {0, 0, 0}, {}, k.restitution, ballRadius, k.massRatio);
    return scene;
}

}  // namespace ballpit::stability
