// Chapter 07: the physics of one contact between two balls.
#pragma once

#include "common/bodies.cuh"

namespace ballpit {

/// Where two overlapping balls press on each other.
struct Contact {
    Vec3 normal;        ///< unit vector from the first ball to the second
    float penetration;  ///< m: how far they overlap along the normal
};

/// The contact of balls a and b (x, y, z, radius). Coincident centres have no direction: the ball
/// with the smaller id is then taken to lie below the other, so that both agree.
HD inline Contact contactBetween(Vec4 a, Vec4 b, std::uint32_t idA, std::uint32_t idB) {
    const Vec3 offset = xyz(b) - xyz(a);
    const float distance = length(offset);
    const Vec3 up{0.0f, idA < idB ? 1.0f : -1.0f, 0.0f};
    const Vec3 normal = distance > 0.0f ? offset / distance : up;
    return {normal, a.w + b.w - distance};
}

/// Of two different balls the duller one decides how they bounce.
HD inline float combinedRestitution(float a, float b) { return minimum(a, b); }

/// Speed at which b leaves a along the normal, m/s; negative while they approach.
HD inline float separationSpeed(Vec4 velocityA, Vec4 velocityB, Vec3 normal) {
    return dot(xyz(velocityB) - xyz(velocityA), normal);
}

/// The impulse on b along the normal (a gets the opposite), N s:
///     J = -(1 + e) v_n / (1/m_a + 1/m_b)    with v_n the separation speed, v_n < 0.
/// `inverseMassSum` is the denominator; mass splitting passes larger terms for busy balls.
HD inline float impulseAlongNormal(float separation, float restitution, float inverseMassSum) {
    return -(1.0f + restitution) * separation / inverseMassSum;
}

}  // namespace ballpit
