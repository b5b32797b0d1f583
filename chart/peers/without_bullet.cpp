// A build without Bullet.
#include "chart/peers/peer_runner.h"

namespace ballpit::chart {

void addBullet(Peers& peers) {
    peers.missing.emplace_back("Bullet is not part of this build: install libbullet-dev");
}

}  // namespace ballpit::chart
