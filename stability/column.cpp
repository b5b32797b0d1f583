// Scenes of balls that rest on each other, exactly one above the other.
#include "stability/worlds.h"

namespace ballpit::stability {

Scene makeColumn(int count, float restitution) {
    Scene scene =
        worldWithGravity("column", {{-2, 0, -2}, {2, static_cast<float>(count) + 3.0f, 2}});
    for (int k = 0; k < count; ++k)
        addBall(scene, {0, ballRadius + static_cast<float>(k), 0}, {}, restitution);
    return scene;
}

Scene makeHeavyOnLight(float ratio, float restitution) {
    Scene scene = worldWithGravity("heavy_on_light", {{-2, 0, -2}, {2, 5, 2}});
    addBall(scene, {0, ballRadius, 0}, {}, restitution);
    addBall(scene, {0, 3.0f * ballRadius, 0}, {}, restitution, ballRadius, ratio);
    return scene;
}

}  // namespace ballpit::stability
