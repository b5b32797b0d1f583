// SimBenchmark's scene of bouncing balls (leggedrobotics/SimBenchmark, benchmark "bouncing").
#include "stability/worlds.h"

namespace ballpit::stability {

Scene makeBounce(float restitution) {
    constexpr float radius = 0.1f, mass = 10.0f, height = 5.0f;
    constexpr int side = 7;
    Scene scene = worldWithGravity("bounce", {{-8, 0, -8}, {8, 12, 8}}, radius);
    for (int k = 0; k < side * side; ++k) {
        const auto x = static_cast<float>(k % side - side / 2);
        const auto z = static_cast<float>(k / side - side / 2);
        addBall(scene, {2.0f * x, height, 2.0f * z}, {}, restitution, radius, mass);
    }
    return scene;
}

}  // namespace ballpit::stability
