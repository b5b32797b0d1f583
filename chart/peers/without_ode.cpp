// A build without ODE.
#include "chart/peers/peer_runner.h"

namespace ballpit::chart {

void addOde(Peers& peers) {
    peers.missing.emplace_back("ODE is not part of this build: install libode-dev");
}

}  // namespace ballpit::chart
