// What the tests of the peers share: the engines by name, and scenes of a ball or two.
#pragma once

#include <cmath>

#include "chart/peers/bullet.h"
#include "chart/peers/ode.h"
#include "stability/worlds.h"
#include "tests/support.h"

namespace ballpit::chart {

using namespace ballpit::stability;

struct Named {
    const char* name;
    std::unique_ptr<Peer> (*make)(const Scene&, const PeerKnobs&);
    int iterations;
};
inline const Named bullet{"bullet", makeBullet, bulletIterations};
inline const Named bulletAsPackaged{"bullet-as-packaged", makeBulletAsPackaged, bulletIterations};
inline const Named ode{"ode", makeOde, odeIterations};
inline const Named odeDantzig{"ode-dantzig", makeOdeDantzig, 1};
inline const std::vector<Named> allPeers{bullet, bulletAsPackaged, ode, odeDantzig};
/// Those that are set up for bounces.
inline const std::vector<Named> bouncers{bullet, ode, odeDantzig};

inline Named eachOf(const std::vector<Named>& peers) {
    const Named peer = GENERATE_COPY(from_range(peers));
    UNSCOPED_INFO("peer: " << peer.name);
    return peer;
}

inline Spheres after(const Named& peer, const Scene& scene, double seconds, float dt) {
    const auto world = peer.make(scene, {dt, peer.iterations});
    const auto steps = std::lround(seconds / dt);
    for (long k = 0; k < steps; ++k) world->step();
    return world->spheres();
}

constexpr Bounds room{{-5, -5, -5}, {5, 5, 5}};

/// Along x, 1 m apart; the first flies at the second.
inline Scene headOnScene(float firstMass, float secondMass, float firstE, float secondE,
                         float speed = 3) {
    Scene scene = emptyWorld("head-on", room);
    addBall(scene, {-2, 0, 0}, {speed, 0, 0}, firstE, ballRadius, firstMass);
    addBall(scene, {0, 0, 0}, {}, secondE, ballRadius, secondMass);
    return scene;
}

inline Scene ballOnFloor(float restitution, float height, Vec3 velocity = {}) {
    Scene scene = worldWithGravity("floor", room);
    addBall(scene, {0, room.lower.y + height, 0}, velocity, restitution);
    return scene;
}

/// It starts in the middle of the room and needs a second to the wall, if it has 4 m/s.
inline Scene ballAtWall(Vec3 velocity) {
    Scene scene = emptyWorld("wall", room);
    addBall(scene, {}, velocity);
    return scene;
}

}  // namespace ballpit::chart
