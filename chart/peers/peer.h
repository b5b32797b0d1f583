// Another engine that runs one of our scenes: what the chart asks of it, and what all of them
// share. Balls have no friction, so they do not turn; walls are six planes; each engine runs on one
// thread.
#pragma once

#include <array>
#include <memory>
#include <stdexcept>
#include <tuple>

#include "common/scene.h"

namespace ballpit::chart {

/// What a curve of a peer is traced by.
struct PeerKnobs {
    float dt = 1.0f / 60.0f;  ///< s
    int iterations = 1;       ///< of its solver, a step; those without iterations take no notice
};

class Peer {
public:
    Peer() = default;
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;
    virtual ~Peer() = default;

    /// One step of PeerKnobs::dt. SolverGaveUp, NotFiniteError.
    virtual void step() = 0;
    /// Positions and velocities of now, in the scene's order; all else as in the scene.
    virtual Spheres spheres() const = 0;
    /// Contacts that the last step found, of two balls and of balls and walls.
    virtual std::size_t contacts() const = 0;
};

/// An engine reports that it found no solution. It could go on, with a wrong result.
struct SolverGaveUp : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A wall: all x with normal . x >= offset are inside.
struct WallPlane {
    Vec3 normal;
    float offset;  ///< m
};
std::array<WallPlane, 6> wallPlanes(Bounds bounds);

/// `start` with the position and the velocity of body k taken from motionOf(k).
template <class MotionOf>
Spheres movedTo(const Spheres& start, MotionOf motionOf) {
    Spheres now = start;
    for (std::size_t k = 0; k < now.count(); ++k)
        std::tie(now.positions[k], now.velocities[k]) = motionOf(k);
    return now;
}

/// InputError if no peer can run this: air (each engine damps in a way of its own), or knobs that
/// are not above 0.
void refuseForPeer(const Scene& scene, const PeerKnobs& knobs);

}  // namespace ballpit::chart
