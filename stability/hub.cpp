// Scenes in which one ball meets several in the same step.
#include <cmath>
#include <numbers>

#include "stability/worlds.h"

namespace ballpit::stability {

namespace {

constexpr Bounds room{{-10, -10, -10}, {10, 10, 10}};

/// m: how far the ball of the middle goes in the first step; all its contacts are that deep.
constexpr float depth = 1e-3f;

}  // namespace

Scene makePocket(float restitution) {
    Scene scene = emptyWorld("pocket", room);
    const float height = std::sqrt(2.0f / 3.0f), third = 1.0f / std::sqrt(3.0f);
    for (const Vec3 place :
         {Vec3{-0.5f, 0, -0.5f * third}, Vec3{0.5f, 0, -0.5f * third}, Vec3{0, 0, third}})
        addBall(scene, 1.00001f * place, {}, restitution);
    addBall(scene, {0, height + 0.0001f, 0}, {0, -depth / scene.dt, 0}, restitution);
    return scene;
}

Scene makeHub(const Hub& k) {
    constexpr float spokeRadius = 0.1f;
    Scene scene = emptyWorld("hub", room);
    addBall(scene, {0, 0, 0}, {depth / scene.dt, 0, 0}, k.restitution);
    // They touch the hub where it will be: at the end of its first step it is a hair too far.
    const float distance = ballRadius + spokeRadius;
    const float sine = std::sqrt(1.0f - k.cosine * k.cosine);
    for (int n = 0; n < k.spokes; ++n) {
        // In double precision: once rounded, the same on every machine.
        const double angle = 2.0 * std::numbers::pi * n / k.spokes;
        const Vec3 normal{k.cosine, sine * static_cast<float>(std::cos(angle)),
                          sine * static_cast<float>(std::sin(angle))};
        addBall(scene, Vec3{0.999f * depth, 0, 0} + distance * normal, {}, k.restitution,
                spokeRadius, k.massRatio);
    }
    return scene;
}

}  // namespace ballpit::stability
