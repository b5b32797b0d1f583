// The Open Dynamics Engine (ode.org), as Debian packages it. Built for vehicles, robots and other
// bodies on joints in real time; its manual puts "speed and stability over physical accuracy".
#pragma once

#include "chart/peers/peer.h"

namespace ballpit::chart {

constexpr int odeIterations = 20;  ///< its default

/// With dWorldQuickStep: a projected Gauss-Seidel method over the contacts in random order.
std::unique_ptr<Peer> makeOde(const Scene& scene, const PeerKnobs& knobs);

/// With dWorldStep: Dantzig's direct method. Has no iterations; its time grows with the cube of the
/// contacts in a heap.
std::unique_ptr<Peer> makeOdeDantzig(const Scene& scene, const PeerKnobs& knobs);

}  // namespace ballpit::chart
