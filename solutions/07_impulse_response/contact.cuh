// Chapter 07: the physics of one contact between two balls.
#pragma once

#include "common/bodies.cuh"

namespace ballpit {

/// From the centre of the ball in slot a to that of b, m, of any length. Coincident centres have no
/// direction: the ball with the smaller id is then taken to lie below, so that both agree.
HD inline Vec3 lineOfCentres(std::uint32_t a, std::uint32_t b, const BodiesView& bodies) {
    const Vec3 line = xyz(bodies.positions[b]) - xyz(bodies.positions[a]);
    if (lengthSquared(line) > 0.0f) return line;
    return {0.0f, bodies.ids[a] < bodies.ids[b] ? 1.0f : -1.0f, 0.0f};
}

/// How fast b leaves a along their line, times its length, m^2/s: negative while they approach.
/// Velocities: x, y, z in m/s. The sign needs neither a root nor a division.
HD inline float separationAlong(Vec3 line, Vec4 velocityA, Vec4 velocityB) {
    return dot(xyz(velocityB) - xyz(velocityA), line);
}

/// Where two overlapping balls press on each other.
struct Contact {
    Vec3 normal;        ///< unit vector from the first ball to the second
    float penetration;  ///< m: how far they overlap along the normal
    float separation;   ///< m/s: how fast they leave each other; negative while they approach
};

/// The contact of the balls in slots a and b.
HD inline Contact contactBetween(std::uint32_t a, std::uint32_t b, const BodiesView& bodies) {
    const Vec4 sphereA = bodies.positions[a], sphereB = bodies.positions[b];
    const Vec3 line = lineOfCentres(a, b, bodies);
    const float inverseLength = 1.0f / length(line);
    const Vec3 normal = inverseLength * line;
    const float distance = dot(xyz(sphereB) - xyz(sphereA), normal);
    return {normal, sphereA.w + sphereB.w - distance,
            separationAlong(line, bodies.velocities[a], bodies.velocities[b]) * inverseLength};
}

/// Of two different balls the duller one decides how they bounce.
HD inline float combinedRestitution(float a, float b) { return minimum(a, b); }

/// The impulse on b along the normal (a gets the opposite), N s:
///     J = -(1 + e) v_n / (1/m_a + 1/m_b)    with v_n the separation speed, v_n < 0.
/// `inverseMassSum` is the denominator; mass splitting passes larger terms for busy balls.
HD inline float impulseAlongNormal(float separation, float restitution, float inverseMassSum) {
    return -(1.0f + restitution) * separation / inverseMassSum;
}

}  // namespace ballpit
