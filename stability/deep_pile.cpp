// Heaps that settle: of equal balls, and of balls of many sizes.
#include <algorithm>
#include <cmath>

#include "common/random.h"
#include "stability/worlds.h"

namespace ballpit::stability {

namespace {

/// Balls along each edge of a square floor under a heap of `count` that is higher than wide.
int floorSide(int count) {
    constexpr double heightOverWidth = 2.0;
    return std::max(2, static_cast<int>(std::lround(std::cbrt(count / heightOverWidth))));
}

/// The k-th place of a lattice, layer by layer from the floor, `spacing` m apart, shifted at
/// random.
Vec3 looselyPlaced(int k, int side, float spacing, float shift, Random& random) {
    const Vec3 place{static_cast<float>(k % side), static_cast<float>(k / side / side),
                     static_cast<float>(k / side % side)};
    return 0.5f * Vec3{spacing, spacing, spacing} + spacing * place +
           random.uniformIn({{-shift, -shift, -shift}, {shift, shift, shift}});
}

Scene emptyShaft(const char* name, int count, float spacing, float largestRadius) {
    const int side = floorSide(count);
    const float width = spacing * static_cast<float>(side);
    const float height = spacing * (static_cast<float>(count / side / side) + 4.0f);
    return worldWithGravity(name, {{0, 0, 0}, {width, height, width}}, largestRadius);
}

}  // namespace

Scene makeDeepPile(int count, std::uint64_t seed) {
    constexpr float spacing = 1.06f, shift = 0.025f;
    Scene scene = emptyShaft("deep_pile", count, spacing, ballRadius);
    Random random(seed);
    for (int k = 0; k < count; ++k)
        addBall(scene, looselyPlaced(k, floorSide(count), spacing, shift, random), {}, 0.0f);
    return scene;
}

Scene makeMixedRadii(int count, float ratio, std::uint64_t seed) {
    const float largest = ballRadius * std::sqrt(ratio), smallest = largest / ratio;
    const float spacing = 2.05f * largest;
    Scene scene = emptyShaft("mixed_radii", count, spacing, largest);
    Random random(seed);
    for (int k = 0; k < count; ++k) {
        const Vec3 place = looselyPlaced(k, floorSide(count), spacing, 0.02f * largest, random);
        const float radius = random.uniform(smallest, largest);
        addBall(scene, place, {}, 0.3f, radius, 8.0f * radius * radius * radius);
    }
    return scene;
}

}  // namespace ballpit::stability
