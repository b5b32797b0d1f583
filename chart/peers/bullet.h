// Bullet (pybullet.org), as Debian packages it. Built for games, film and robotics: shapes of all
// kinds, joints and soft bodies, at 60 steps a second, where what looks right is right.
#pragma once

#include "chart/peers/peer.h"

namespace ballpit::chart {

constexpr int bulletIterations = 10;  ///< its default

/// Set up as its authors advise for our questions (docs/peers.md): defaults where balls are dull;
/// restitution without bias where they bounce. Nothing sleeps, so that every step is computed.
std::unique_ptr<Peer> makeBullet(const Scene& scene, const PeerKnobs& knobs);

/// As a newcomer gets it: all settings at their defaults, and a heap at rest falls asleep.
std::unique_ptr<Peer> makeBulletAsPackaged(const Scene& scene, const PeerKnobs& knobs);

}  // namespace ballpit::chart
