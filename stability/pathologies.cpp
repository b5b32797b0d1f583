// Scenes that no engine can be right about. It can only keep its bodies and say what happened.
#include "common/random.h"
#include "stability/worlds.h"

namespace ballpit::stability {

namespace {

constexpr Bounds room{{-10, -10, -10}, {10, 10, 10}};

}  // namespace

Scene makeOneCell(int count, std::uint64_t seed) {
    Scene scene = emptyWorld("one_cell", room);
    Random random(seed);
    for (int k = 0; k < count; ++k)
        addBall(scene, random.uniformIn({{0.1f, 0.1f, 0.1f}, {1.1f, 1.1f, 1.1f}}), {}, 0.5f);
    return scene;
}

Scene makeCoincident(int count) {
    Scene scene = emptyWorld("coincident", room);
    for (int k = 0; k < count; ++k)
        addBall(scene, {static_cast<float>(k / 2 % 8) * 2.0f - 7.0f,
                        static_cast<float>(k / 16 % 8) * 2.0f - 7.0f,
                        static_cast<float>(k / 128 % 8) * 2.0f - 7.0f});
    return scene;
}

Scene makeNotFinite() {
    // Narrow, so that wherever the walls put the two, they overlap.
    Scene scene = emptyWorld("not_finite", {{0, 0, 0}, {1.5f, 4, 4}});
    addBall(scene, {0.5f, 2, 2}, {2e38f, 0, 0});
    addBall(scene, {1.0f, 2, 2}, {-2e38f, 0, 0});
    return scene;
}

Scene makeOutside(int count, std::uint64_t seed) {
    Scene scene = emptyWorld("outside", room);
    Random random(seed);
    for (int k = 0; k < count; ++k) {
        Vec3 place = random.uniformIn({{-9, -9, -9}, {9, 9, 9}});
        float& axis = k % 3 == 0 ? place.x : k % 3 == 1 ? place.y : place.z;
        axis = k % 2 == 0 ? -1000.0f : 1000.0f;
        addBall(scene, place, {}, 0.5f);
    }
    return scene;
}

Scene makeFarFromOrigin(int count, float distance) {
    Scene scene = makeColumn(count, 0.0f);
    scene.name = "far_from_origin";
    const Vec3 shift{distance, distance, distance};
    for (Vec3& place : scene.spheres.positions) place += shift;
    scene.bounds = {scene.bounds.lower + shift, scene.bounds.upper + shift};
    return scene;
}

}  // namespace ballpit::stability
