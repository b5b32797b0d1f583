// The scene of a single collision, and one of many.
#include <cmath>

#include "common/random.h"
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

Scene makeMeetings(int pairs, std::uint64_t seed) {
    constexpr float lane = 4.0f;  // m: none comes near its neighbours
    const int side = static_cast<int>(std::ceil(std::sqrt(pairs)));
    const float width = lane * static_cast<float>(side);
    Scene scene = emptyWorld("two_bodies", {{-6, -lane, -lane}, {6, width, width}});
    Random random(seed);
    for (int k = 0; k < pairs; ++k) {
        // Uniform over the disc of aims: b^2 is.
        const float share = (static_cast<float>(k) + 0.5f) / static_cast<float>(pairs);
        const Scene one =
            makeTwoBodies({.offset = std::sqrt(share), .phase = random.uniform(0.0f, 1.0f)});
        const Vec3 place{0, lane * static_cast<float>(k % side),
                         lane * static_cast<float>(k / side)};
        for (std::size_t n = 0; n < 2; ++n)
            addBall(scene, one.spheres.positions[n] + place, one.spheres.velocities[n]);
    }
    return scene;
}

}  // namespace ballpit::stability
