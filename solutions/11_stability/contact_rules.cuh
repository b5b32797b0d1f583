// Chapter 11: one contact under rules that can be set. The physics is chapter 07's.
#pragma once

#include "07_impulse_response/contact.cuh"

namespace ballpit {

struct ContactRules {
    float relaxation;            ///< the share of impulse and push that is used
    float positionShare;         ///< the share of an overlap that a push takes away
    float restitutionThreshold;  ///< m/s: balls that approach more slowly do not bounce
};

/// The restitution of two bodies that approach with `separation` < 0 m/s.
HD inline float restitutionAt(float separation, std::uint32_t a, std::uint32_t b,
                              const BodiesView& bodies, float threshold) {
    if (separation > -threshold) return 0.0f;
    return combinedRestitution(bodies.restitutions[a], bodies.restitutions[b]);
}

/// What a contact does to its second body, along the normal; the first gets the opposite.
struct NormalEffect {
    Vec3 normal;    ///< unit vector from the first body to the second
    float impulse;  ///< N s
    float push;     ///< kg m
};

/// The effect of one contact as if there were no other: chapter 07's effectOfPair under `rules`.
/// Bodies that another contact has parted already are not pushed back together.
HD inline NormalEffect effectUnder(const ContactRules& rules, std::uint32_t a, std::uint32_t b,
                                   const BodiesView& bodies) {
    const float inverseMassSum = bodies.velocities[a].w + bodies.velocities[b].w;
    const Contact contact = contactBetween(a, b, bodies);
    const float overlap = rules.positionShare * maximum(contact.penetration, 0.0f);
    float impulse = 0.0f;
    if (contact.separation < 0.0f)
        impulse = impulseAlongNormal(
            contact.separation,
            restitutionAt(contact.separation, a, b, bodies, rules.restitutionThreshold),
            inverseMassSum);
    return {contact.normal, rules.relaxation * impulse,
            rules.relaxation * pushAlongNormal(overlap, inverseMassSum)};
}

}  // namespace ballpit
