// Straight lines between walls.
#include "common/motion.h"

#include <algorithm>
#include <cmath>

namespace ballpit {

namespace {

/// Not chapter 07's bounceOffWalls: a film of chapter 01 must not need a later piece.
void moveAlong(float& position, float& velocity, float lower, float upper) {
    position += velocity / 60.0f;
    if (position < lower) velocity = std::abs(velocity);
    if (position > upper) velocity = -std::abs(velocity);
    position = std::clamp(position, lower, upper);
}

}  // namespace

void stir(Spheres& spheres, Vec3 fastest, std::uint64_t seed) {
    Random random(seed);
    for (Vec3& velocity : spheres.velocities) velocity = random.uniformIn({-fastest, fastest});
}

void showFirst(Spheres& spheres, const std::vector<float>& radii, float share) {
    for (std::size_t k = 0; k < spheres.count(); ++k) {
        const float place = static_cast<float>(k) / static_cast<float>(spheres.count());
        spheres.radii[k] = radii[k] * std::clamp(50.0f * (share / 0.73f - place), 0.0f, 1.0f);
    }
}

void drift(Spheres& spheres, Bounds world) {
    for (std::size_t k = 0; k < spheres.count(); ++k) {
        Vec3 &p = spheres.positions[k], &v = spheres.velocities[k];
        moveAlong(p.x, v.x, world.lower.x, world.upper.x);
        moveAlong(p.y, v.y, world.lower.y, world.upper.y);
        moveAlong(p.z, v.z, world.lower.z, world.upper.z);
    }
}

}  // namespace ballpit
