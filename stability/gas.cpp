// Gases between walls: elastic ones that should keep their energy, dull ones that should cool.
#include <cmath>

#include "common/random.h"
#include "stability/worlds.h"

namespace ballpit::stability {

namespace {

/// Takes the mean velocity away and scales the rest to the root mean square `speed`. In double
/// precision, in body order.
void setSpeed(Spheres& spheres, double speed) {
    const double share = 1.0 / static_cast<double>(spheres.count());
    double x = 0, y = 0, z = 0;
    for (const Vec3 v : spheres.velocities) x += v.x, y += v.y, z += v.z;
    const Vec3 mean{static_cast<float>(share * x), static_cast<float>(share * y),
                    static_cast<float>(share * z)};
    double squares = 0;
    for (Vec3& v : spheres.velocities) {
        v = v - mean;
        squares += lengthSquared(v);
    }
    const auto scale = static_cast<float>(speed / std::sqrt(share * squares));
    for (Vec3& v : spheres.velocities) v = scale * v;
}

}  // namespace

Scene makeGasOf(const Gas& k) {
    constexpr double ballVolume = 0.5235987755982988;  // of diameter 1 m
    const auto side = static_cast<float>(std::cbrt(k.count * ballVolume / k.volumeShare));
    Scene scene = emptyWorld(k.restitution < 1.0f ? "cooling_gas" : "elastic_gas",
                             {{0, 0, 0}, {side, side, side}});
    scene.periodic = k.periodic;
    scene.dt = k.travel * ballRadius / gasSpeed;
    const int along = static_cast<int>(std::ceil(std::cbrt(double(k.count)) - 1e-9));
    // Centres half a spacing from the walls, if that leaves a radius and a hair.
    const float half = 0.5f * side / static_cast<float>(along);
    const float first = k.periodic ? half : std::fmax(half, 1.001f * ballRadius);
    const float spacing = along > 1 ? (side - 2.0f * first) / static_cast<float>(along - 1) : 0.0f;
    Random random(k.seed);
    for (int n = 0; n < k.count; ++n) {
        const Vec3 place{static_cast<float>(n % along), static_cast<float>(n / along % along),
                         static_cast<float>(n / along / along)};
        addBall(scene, Vec3{first, first, first} + spacing * place,
                random.uniformIn({{-1, -1, -1}, {1, 1, 1}}), k.restitution);
    }
    setSpeed(scene.spheres, k.count > 1 ? gasSpeed : 0.0);
    return scene;
}

}  // namespace ballpit::stability
