// SimBenchmark's heap of 6 x 6 x 6 balls (leggedrobotics/SimBenchmark, benchmarks "666" and
// "elastic 666").
#include "common/random.h"
#include "stability/worlds.h"

namespace ballpit::stability {

Scene makeSixCubed(float restitution, std::uint64_t seed) {
    constexpr float radius = 0.1f, mass = 10.0f, gap = 0.21f, shift = 1e-3f;
    constexpr int side = 6;
    constexpr float width = gap * side;
    Scene scene = worldWithGravity(restitution > 0.0f ? "six_cubed_elastic" : "six_cubed",
                                   {{0, 0, 0}, {width, 4, width}}, radius);
    Random random(seed);
    for (int k = 0; k < side * side * side; ++k) {
        const Vec3 place{static_cast<float>(k % side), static_cast<float>(k / side / side),
                         static_cast<float>(k / side % side)};
        addBall(scene,
                0.5f * Vec3{gap, gap, gap} + gap * place +
                    random.uniformIn({{-shift, -shift, -shift}, {shift, shift, shift}}),
                {}, restitution, radius, mass);
    }
    return scene;
}

}  // namespace ballpit::stability
