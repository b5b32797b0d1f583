// Chapter 07: the physics of one contact between two balls.
#pragma once

#include "common/bodies.cuh"
//@starter #include "common/hole.cuh"

namespace ballpit {

/// From the centre of the ball in slot a to that of b, m, of any length. Coincident centres have no
/// direction: the ball with the smaller id is then taken to lie below, so that both agree.
HD inline Vec3 lineOfCentres(std::uint32_t a, std::uint32_t b, const BodiesView& bodies) {
    const Vec3 line = betweenCentres(a, b, bodies);
    //@hole impulse.line lines=2 "The line, but if the centres coincide, up or down by id"
    //@starter TODO_HOLE("impulse.line");
    //@starter return line;
    if (lengthSquared(line) > 0.0f) return line;
    return {0.0f, bodies.ids[a] < bodies.ids[b] ? 1.0f : -1.0f, 0.0f};
    //@end
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

/// The contact of the balls in slots a and b. Always inlined: a compiler that calls it instead
/// takes a tenth longer for a whole response.
[[gnu::always_inline]] HD inline Contact contactBetween(std::uint32_t a, std::uint32_t b,
                                                        const BodiesView& bodies) {
    const Vec3 between = betweenCentres(a, b, bodies), line = lineOfCentres(a, b, bodies);
    const float reach = bodies.positions[a].w + bodies.positions[b].w;
    //@hole impulse.contact lines=4 "Normal, overlap, and speed of separation, from the line"
    //@starter TODO_HOLE("impulse.contact");
    //@starter return {line, 0.0f, 0.0f};
    const float inverseLength = 1.0f / length(line);
    const Vec3 normal = inverseLength * line;
    return {normal, reach - dot(between, normal),
            separationAlong(line, bodies.velocities[a], bodies.velocities[b]) * inverseLength};
    //@end
}

/// Of two different balls the duller one decides how they bounce.
HD inline float combinedRestitution(float a, float b) { return minimum(a, b); }

/// The impulse on b along the normal (a gets the opposite), N s:
///     J = -(1 + e) v_n / (1/m_a + 1/m_b)    with v_n the separation speed, v_n < 0.
/// `inverseMassSum` is the denominator; mass splitting passes larger terms for busy balls.
HD inline float impulseAlongNormal(float separation, float restitution, float inverseMassSum) {
    //@hole impulse.along_normal lines=1 "The impulse J along the normal"
    //@starter TODO_HOLE("impulse.along_normal");
    //@starter return 0.0f;
    return -(1.0f + restitution) * separation / inverseMassSum;
    //@end
}

/// The push on b along the normal (a gets the opposite), kg m. Divided by each ball's mass it gives
/// the two ways in m, which together are the penetration: the lighter ball gives way more.
HD inline float pushAlongNormal(float penetration, float inverseMassSum) {
    //@hole impulse.push lines=1 "The push that takes the overlap away"
    //@starter TODO_HOLE("impulse.push");
    //@starter return 0.0f;
    return penetration / inverseMassSum;
    //@end
}

/// What a contact does to its second ball; the first gets the opposite of both.
struct PairEffect {
    Vec3 impulse;  ///< N s: times 1/m, a change of velocity
    Vec3 push;     ///< kg m: times 1/m, a change of position
};

/// The effect of one contact as if there were no other. No impulse unless the balls approach: those
/// that leave each other would be pulled back.
HD inline PairEffect effectOfPair(std::uint32_t a, std::uint32_t b, const BodiesView& bodies) {
    const float inverseMassSum = bodies.velocities[a].w + bodies.velocities[b].w;
    const float restitution = combinedRestitution(bodies.restitutions[a], bodies.restitutions[b]);
    const Contact contact = contactBetween(a, b, bodies);
    //@hole impulse.pair lines=5 "Impulse (only if they approach) and push, as vectors"
    //@starter TODO_HOLE("impulse.pair");
    //@starter return {};
    const float push = pushAlongNormal(contact.penetration, inverseMassSum);
    float impulse = 0.0f;
    if (contact.separation < 0.0f)
        impulse = impulseAlongNormal(contact.separation, restitution, inverseMassSum);
    return {impulse * contact.normal, push * contact.normal};
    //@end
}

}  // namespace ballpit
