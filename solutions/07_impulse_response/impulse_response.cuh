// Chapter 07: the engine's default response: impulses and position corrections, gathered per body.
//
// Each body adds up what its contacts do to it, in a fixed order, and writes only itself: no
// atomics on floats, the same bits on every machine. A plain sum of the pair impulses would push a
// ball with several contacts too hard (one elastic ball into a pocket of three leaves with three
// times its energy). So masses are split (Tonge, Benevolenski and Voroshilov, "Mass splitting for
// jitter-free parallel rigid body simulation", SIGGRAPH 2012): a body with n contacts enters each
// of them with 1/n of its mass. Both partners compute the same impulse, so momentum is conserved,
// and kinetic energy never grows. Split counts only approaching contacts: the others get no
// impulse and need no share.
//
// Where it fails: it gives each contact too little, so a deep pile sinks into itself and a dense
// elastic gas loses energy. Chapters 11 and 12 show where, and what to use there.
#pragma once

#include "07_impulse_response/contact.cuh"
#include "07_impulse_response/contact_lists.cuh"
#include "common/atomics.cuh"
#include "common/response.h"

namespace ballpit {

/// How many contacts a body has, and in how many of them it approaches its partner.
struct ContactCounts {
    std::uint32_t touching, approaching;
};

/// Sorts body i's incoming partners and counts its contacts.
HD inline void countContacts(int i, BodiesView bodies, ContactsView contacts,
                             View<ContactCounts> counts) {
    sortIncoming(i, contacts);
    const Vec4 sphere = bodies.positions[i], moving = bodies.velocities[i];
    const std::uint32_t id = bodies.ids[i];
    ContactCounts mine{0, 0};
    visitPartners(i, contacts, [&](std::uint32_t j) {
        const Contact contact = contactBetween(sphere, bodies.positions[j], id, bodies.ids[j]);
        const float separation = separationSpeed(moving, bodies.velocities[j], contact.normal);
        ++mine.touching;
        if (separation < 0.0f) ++mine.approaching;
    });
    counts[i] = mine;
}

/// 1/m of the share that a body of mass `mass` (kg) brings to each of `contactCount` contacts.
HD inline float splitInverseMass(float mass, std::uint32_t contactCount) {
    return static_cast<float>(contactCount) / mass;
}

/// What one round of contacts does to a body.
struct Change {
    Vec3 velocity;  ///< m/s
    Vec3 position;  ///< m
};

/// What the contact with body j does to body i. Swapping i and j gives exactly the opposite
/// impulse and the opposite push, to the last bit.
HD inline Change changeFromContact(int i, std::uint32_t j, const BodiesView& bodies,
                                   View<const ContactCounts> counts) {
    const Vec4 velocityI = bodies.velocities[i], velocityJ = bodies.velocities[j];
    const float massI = velocityI.w, massJ = velocityJ.w;
    const Contact contact =
        contactBetween(bodies.positions[i], bodies.positions[j], bodies.ids[i], bodies.ids[j]);
    const ContactCounts countsI = counts[i], countsJ = counts[j];
    Change change;

    const float separation = separationSpeed(velocityI, velocityJ, contact.normal);
    if (separation < 0.0f) {
        const float impulse = impulseAlongNormal(
            separation, combinedRestitution(bodies.restitutions[i], bodies.restitutions[j]),
            splitInverseMass(massI, countsI.approaching) +
                splitInverseMass(massJ, countsJ.approaching));
        change.velocity = -(impulse / massI) * contact.normal;
    }

    const float push = contact.penetration / (splitInverseMass(massI, countsI.touching) +
                                              splitInverseMass(massJ, countsJ.touching));
    change.position = -(push / massI) * contact.normal;
    return change;
}

/// Adds up what all contacts do to body i, and writes its new velocity and position to `to`.
HD inline void collisionResponse(int i, ResponseRound round, ContactsView contacts,
                                 View<const ContactCounts> counts) {
    const Vec4 sphere = round.from.positions[i], moving = round.from.velocities[i];
    Change sum;
    visitPartners(i, contacts, [&](std::uint32_t j) {
        const Change change = changeFromContact(i, j, round.from, counts);
        sum.velocity += change.velocity;
        sum.position += change.position;
    });

    const Vec3 position = xyz(sphere) + sum.position, velocity = xyz(moving) + sum.velocity;
    if (!isFinite(position) || !isFinite(velocity))
        lowerTo(round.status[0].notFiniteAfterImpulse, round.from.ids[i]);
    // Every thread that gets here writes the same 1, so the order cannot show.
    if (length(sum.position) > round.motionShare * (round.halfCell - sphere.w))
        round.status[0].staleGrid = 1;
    round.to.positions[i] = withW(position, sphere.w);
    round.to.velocities[i] = withW(velocity, moving.w);
}

/// Mass-split impulses, gathered.
class ImpulseResponse : public Response {
public:
    ImpulseResponse(Device device, std::size_t bodyCount, std::size_t pairCapacity)
        : device_(device),
          lists_(device, bodyCount, pairCapacity),
          counts_(device, bodyCount, "contactCounts") {}

    void resolve(const ResponseRound& round, Scratch& scratch) override {
        const ContactsView contacts = lists_.collect(round.bodyCount, round.pairs, scratch);
        launch<countContacts>(device_, round.bodyCount, round.from, contacts, counts_.view());
        launch<collisionResponse>(device_, round.bodyCount, round, contacts, counts_.view());
    }
    void reserve(std::size_t pairCapacity) override { lists_.reserve(pairCapacity); }
    std::size_t bytes() const override { return lists_.bytes() + counts_.bytes(); }

    static std::size_t predictedBytes(std::size_t bodyCount, std::size_t pairCapacity) {
        return (2 * bodyCount + 1 + pairCapacity) * sizeof(std::uint32_t) +
               bodyCount * sizeof(ContactCounts);
    }

private:
    Device device_;
    ContactLists lists_;
    DeviceBuffer<ContactCounts> counts_;
};

}  // namespace ballpit
