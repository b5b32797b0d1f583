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
    const float inverseMassSum = velocityA.w + velocityB.w;
    const Contact contact = contactBetween(a, b, bodies);

    if (contact.separation < 0.0f) {
        const float impulse = impulseAlongNormal(
            contact.separation, combinedRestitution(bodies.restitutions[a], bodies.restitutions[b]),
            inverseMassSum);
        const Vec3 kick = impulse * contact.normal;
        bodies.velocities[a] = withW(xyz(velocityA) - velocityA.w * kick, velocityA.w);
        bodies.velocities[b] = withW(xyz(velocityB) + velocityB.w * kick, velocityB.w);
    }
    const Vec3 push = (contact.penetration / inverseMassSum) * contact.normal;
    bodies.positions[a] = withW(xyz(sphereA) - velocityA.w * push, sphereA.w);
    bodies.positions[b] = withW(xyz(sphereB) + velocityB.w * push, sphereB.w);
}

/// All pairs of body i, in place. This is the race: other threads hold the same bodies.
HD inline void collisionResponseRacy(int i, ResponseRound round) {
    for (std::uint32_t k = round.pairs.starts[i]; k < round.pairs.endOf(i); ++k)
        resolvePairInPlace(round.pairs.pairs[k].first, round.pairs.pairs[k].second, round.to);
}

/// Reports what collisionResponse reports, after the fact.
HD inline void reportRound(int i, ResponseRound round) {
    const Vec3 before = xyz(round.from.positions[i]), after = xyz(round.to.positions[i]);
    reportMotion(i, round, after - before, after, xyz(round.to.velocities[i]));
}

/// In place, in parallel, without atomics.
class RacyResponse : public Response {
public:
    explicit RacyResponse(Device device) : device_(device) {}

    void resolve(const ResponseRound& round) override {
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
