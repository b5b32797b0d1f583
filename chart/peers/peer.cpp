// What all peers share.
#include "chart/peers/peer.h"

#include "common/error.h"

namespace ballpit::chart {

std::array<WallPlane, 6> wallPlanes(Bounds bounds) {
    const auto [lower, upper] = bounds;
    return {{{{1, 0, 0}, lower.x},
             {{0, 1, 0}, lower.y},
             {{0, 0, 1}, lower.z},
             {{-1, 0, 0}, -upper.x},
             {{0, -1, 0}, -upper.y},
             {{0, 0, -1}, -upper.z}}};
}

void refuseForPeer(const Scene& scene, const PeerKnobs& knobs) {
    if (scene.damping != 0.0f)
        throw InputError("damping " + std::to_string(scene.damping) +
                         ": other engines damp in ways of their own; compare with damping 0");
    if (!(knobs.dt > 0.0f))
        throw InputError("dt " + std::to_string(knobs.dt) + ": must be above 0");
    if (knobs.iterations < 1)
        throw InputError("iterations " + std::to_string(knobs.iterations) + ": must be 1 or more");
}

}  // namespace ballpit::chart
