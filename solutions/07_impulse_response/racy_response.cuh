// Chapter 07's exhibit: the original design's response, taken literally: every pair changes both
// of its bodies in place, all pairs at once. Two pairs that share a body read and write it at the
// same time; updates get lost, momentum leaks, and no two runs agree. Kept to show that.
#pragma once

#include "07_impulse_response/contact.cuh"
#include "common/launch.cuh"
#include "common/response.h"

namespace ballpit {

/// The round starts from a copy, since the engine never overwrites the state a step began with.
HD inline void copyBody(int i, BodiesView from, BodiesView to) {
    to.positions[i] = from.positions[i];
    to.velocities[i] = from.velocities[i];
}

/// Resolves the contact of bodies a and b in place.
HD inline void resolvePairInPlace(std::uint32_t a, std::uint32_t b, const BodiesView& bodies) {
    const Vec4 velocityA = bodies.velocities[a], velocityB = bodies.velocities[b];
    const Vec4 sphereA = bodies.positions[a], sphereB = bodies.positions[b];
    const float inverseMassA = 1.0f / velocityA.w, inverseMassB = 1.0f / velocityB.w;
    const float inverseMassSum = inverseMassA + inverseMassB;
    const Contact contact = contactBetween(sphereA, sphereB, bodies.ids[a], bodies.ids[b]);

    const float separation = separationSpeed(velocityA, velocityB, contact.normal);
    if (separation < 0.0f) {
        const float impulse = impulseAlongNormal(
            separation, combinedRestitution(bodies.restitutions[a], bodies.restitutions[b]),
            inverseMassSum);
        const Vec3 kick = impulse * contact.normal;
        bodies.velocities[a] = withW(xyz(velocityA) - inverseMassA * kick, velocityA.w);
        bodies.velocities[b] = withW(xyz(velocityB) + inverseMassB * kick, velocityB.w);
    }
    const Vec3 push = (contact.penetration / inverseMassSum) * contact.normal;
    bodies.positions[a] = withW(xyz(sphereA) - inverseMassA * push, sphereA.w);
    bodies.positions[b] = withW(xyz(sphereB) + inverseMassB * push, sphereB.w);
}

/// All pairs of body i, in place. This is the race: other threads hold the same bodies.
HD inline void collisionResponseRacy(int i, ResponseRound round) {
    for (std::uint32_t k = round.pairs.starts[i]; k < round.pairs.endOf(i); ++k)
        resolvePairInPlace(round.pairs.pairs[k].first, round.pairs.pairs[k].second, round.to);
}

/// Reports what collisionResponse reports, after the fact.
HD inline void reportRound(int i, ResponseRound round) {
    const Vec3 before = xyz(round.from.positions[i]), after = xyz(round.to.positions[i]);
    if (!isFinite(after) || !isFinite(xyz(round.to.velocities[i])))
        lowerTo(round.status[0].notFiniteAfterImpulse, round.from.ids[i]);
    if (length(after - before) > round.motionShare * (round.halfCell - round.from.positions[i].w))
        round.status[0].staleGrid = 1;
}

/// In place, in parallel, without atomics.
class RacyResponse : public Response {
public:
    explicit RacyResponse(Device device) : device_(device) {}

    void resolve(const ResponseRound& round, Scratch&) override {
        launch<copyBody>(device_, round.bodyCount, round.from, round.to);
        launch<collisionResponseRacy>(device_, round.bodyCount, round);
        launch<reportRound>(device_, round.bodyCount, round);
    }
    void reserve(std::size_t) override {}
    std::size_t bytes() const override { return 0; }

private:
    Device device_;
};

}  // namespace ballpit
