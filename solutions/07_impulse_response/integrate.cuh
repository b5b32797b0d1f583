// Chapter 07: one step of motion without collisions between bodies, and the walls.
#pragma once

#include "common/atomics.cuh"
#include "common/bodies.cuh"
//@starter #include "common/hole.cuh"

namespace ballpit {

/// What moves the bodies between collisions.
struct MotionSettings {
    Vec3 gravity;   ///< m/s^2
    float damping;  ///< 1/s: the share of its velocity a body loses a second
    float dt;       ///< s
    Bounds walls;   ///< m
};

/// Along one axis: a body beyond a wall is put back on it, and if it was moving on, it bounces.
/// `position` in m, `velocity` in m/s; `lower` and `upper` already shrunk by the radius.
HD inline void bounceOffWalls(float& position, float& velocity, float lower, float upper,
                              float restitution) {
    //@hole motion.walls lines=7 "Back onto the wall; bounce only if it moves on outwards"
    //@starter TODO_HOLE("motion.walls");
    if (position < lower) {
        position = lower;
        if (velocity < 0.0f) velocity = -restitution * velocity;
    } else if (position > upper) {
        position = upper;
        if (velocity > 0.0f) velocity = -restitution * velocity;
    }
    //@end
}

/// Semi-implicit Euler for body i: v += g dt, v *= 1 - damping dt, x += v dt; then the walls.
/// First order in dt, and stable where explicit Euler gains energy.
HD inline void integrate(int i, BodiesView from, BodiesView to, MotionSettings motion,
                         View<StepStatus> status) {
    const Vec4 sphere = from.positions[i];
    const Vec4 moving = from.velocities[i];
    const float radius = sphere.w, restitution = from.restitutions[i];

    //@hole motion.integrate lines=3 "Semi-implicit Euler: velocity first, then position with it"
    //@starter TODO_HOLE("motion.integrate");
    //@starter Vec3 velocity = xyz(moving), position = xyz(sphere);
    Vec3 velocity = xyz(moving) + motion.dt * motion.gravity;
    velocity = (1.0f - motion.damping * motion.dt) * velocity;
    Vec3 position = xyz(sphere) + motion.dt * velocity;
    //@end

    const Bounds& walls = motion.walls;
    bounceOffWalls(position.x, velocity.x, walls.lower.x + radius, walls.upper.x - radius,
                   restitution);
    bounceOffWalls(position.y, velocity.y, walls.lower.y + radius, walls.upper.y - radius,
                   restitution);
    bounceOffWalls(position.z, velocity.z, walls.lower.z + radius, walls.upper.z - radius,
                   restitution);

    if (!isFinite(position) || !isFinite(velocity))
        lowerTo(status[0].notFiniteAfterMoving, from.ids[i]);
    to.positions[i] = withW(position, radius);
    to.velocities[i] = withW(velocity, moving.w);
}

}  // namespace ballpit
