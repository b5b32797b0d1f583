// Newton's cradle.
#include "stability/worlds.h"

namespace ballpit::stability {

Scene makeCradle(int count, bool reversed) {
    const float room = static_cast<float>(count) + 10.0f;
    Scene scene = emptyWorld(reversed ? "newtons_cradle_reversed" : "newtons_cradle",
                             {{-5, -2, -2}, {room, 2, 2}});
    scene.dt = 1.0f / 64.0f;  // a power of two: the places below are met exactly
    for (int k = 0; k < count; ++k) {
        const int place = reversed ? count - 1 - k : k;
        // The first ball touches in the middle of the first step.
        const bool first = place == 0;
        addBall(scene, {static_cast<float>(place) - (first ? 0.5f * scene.dt : 0.0f), 0, 0},
                {first ? 1.0f : 0.0f, 0, 0});
    }
    return scene;
}

}  // namespace ballpit::stability
