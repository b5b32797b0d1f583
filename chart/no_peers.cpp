// A build without other engines.
#include "chart/runner.h"

namespace ballpit::chart {

Peers peerRunners() {
    return {{},
            {"Bullet is not part of this build: install libbullet-dev",
             "ODE is not part of this build: install libode-dev"}};
}

}  // namespace ballpit::chart
