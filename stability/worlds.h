// What the scenes of this folder share: empty worlds.
#pragma once

#include <string>

#include "stability/scenes.h"

namespace ballpit::stability {

/// No gravity, no damping, steps of 1/60 s, cells with a quarter of room for balls of `radius`.
inline Scene emptyWorld(const std::string& name, Bounds bounds, float radius = ballRadius) {
    return {name, {}, bounds, 2.5f * radius, {0, 0, 0}, 0.0f, 1.0f / 60.0f};
}

inline Scene worldWithGravity(const std::string& name, Bounds bounds, float radius = ballRadius) {
    Scene scene = emptyWorld(name, bounds, radius);
    scene.gravity = {0, -gravityOfEarth, 0};
    return scene;
}

inline void addBall(Scene& scene, Vec3 position, Vec3 velocity = {}, float restitution = 1.0f,
                    float radius = ballRadius, float mass = 1.0f) {
    scene.spheres.add(position, velocity, radius, mass, restitution,
                      paletteColor(scene.spheres.count()));
}

}  // namespace ballpit::stability
