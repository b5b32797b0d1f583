// A way to use another engine, as a curve of the chart.
#pragma once

#include "chart/peers/peer.h"
#include "chart/runner.h"

namespace ballpit::chart {

struct PeerMethod {
    std::string engine, method;
    int usualIterations;          ///< 0: it has none
    std::vector<int> iterations;  ///< worth trying besides
    std::vector<std::string> scenes;
    std::unique_ptr<Peer> (*make)(const Scene&, const PeerKnobs&);
};

/// Scenes that the peers are set up for: what SimBenchmark compares engines by, and what stands or
/// lies still.
extern const std::vector<std::string> peerScenes;

void addMethod(Peers& peers, PeerMethod method);

/// The engine's methods, or the line that says that this build has it not: each of the two is
/// defined with the engine, or in without_*.cpp.
void addBullet(Peers& peers);
void addOde(Peers& peers);

}  // namespace ballpit::chart
