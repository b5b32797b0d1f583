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

/// Sorts body i's incoming pairs and counts its contacts.
HD inline void countContacts(int i, BodiesView bodies, ContactsView contacts,
                             View<ContactCounts> counts) {
    sortIncoming(i, contacts);
    ContactCounts mine{0, 0};
    visitPartners(i, contacts, [&](std::uint32_t j) {
        const Vec3 line = lineOfCentres(static_cast<std::uint32_t>(i), j, bodies);
        ++mine.touching;
        if (separationAlong(line, bodies.velocities[i], bodies.velocities[j]) < 0.0f)
            ++mine.approaching;
    });
    counts[i] = mine;
}

/// What one round of contacts does to a body.
struct Change {
    Vec3 velocity;  ///< m/s
    Vec3 position;  ///< m
};

/// What the contact with body j does to body i. Swapping i and j gives exactly the opposite
/// impulse and the opposite push, to the last bit. A body of inverse mass 1/m that splits among n
/// contacts has the inverse mass n/m in each of them.
HD inline Change changeFromContact(std::uint32_t i, std::uint32_t j, const BodiesView& bodies,
                                   View<const ContactCounts> counts) {
    const float inverseMassI = bodies.velocities[i].w, inverseMassJ = bodies.velocities[j].w;
    const ContactCounts countsI = counts[i], countsJ = counts[j];
    const Contact contact = contactBetween(i, j, bodies);
    Change change;

    if (contact.separation < 0.0f) {
        const float impulse = impulseAlongNormal(
            contact.separation, combinedRestitution(bodies.restitutions[i], bodies.restitutions[j]),
            static_cast<float>(countsI.approaching) * inverseMassI +
                static_cast<float>(countsJ.approaching) * inverseMassJ);
        change.velocity = -(impulse * inverseMassI) * contact.normal;
    }

    const float push = contact.penetration / (static_cast<float>(countsI.touching) * inverseMassI +
                                              static_cast<float>(countsJ.touching) * inverseMassJ);
    change.position = -(push * inverseMassI) * contact.normal;
    return change;
}

/// Adds up what all contacts do to body i, and writes its new velocity and position to `to`. Also
/// empties its string of incoming pairs for the next round.
HD inline void collisionResponse(int i, ResponseRound round, ContactsView contacts,
                                 View<const ContactCounts> counts) {
    Change sum;
    visitPartners(i, contacts, [&](std::uint32_t j) {
        const Change change =
            changeFromContact(static_cast<std::uint32_t>(i), j, round.from, counts);
        sum.velocity += change.velocity;
        sum.position += change.position;
    });
    contacts.firstIncoming[i] = noPair;

    const Vec4 sphere = round.from.positions[i], moving = round.from.velocities[i];
    const Vec3 position = xyz(sphere) + sum.position, velocity = xyz(moving) + sum.velocity;
    round.to.positions[i] = withW(position, sphere.w);
    round.to.velocities[i] = withW(velocity, moving.w);
    reportMotion(i, round, sum.position, position, velocity);
}

/// Mass-split impulses, gathered.
class ImpulseResponse : public Response {
public:
    ImpulseResponse(Device device, std::size_t bodyCount, std::size_t pairCapacity)
        : device_(device),
          lists_(device, bodyCount, pairCapacity),
          counts_(device, bodyCount, "contactCounts") {}

    void resolve(const ResponseRound& round) override {
        const ContactsView contacts = lists_.link(round.bodyCount, round.pairs);
        launch<countContacts>(device_, round.bodyCount, round.from, contacts, counts_.view());
        launch<collisionResponse>(device_, round.bodyCount, round, contacts, counts_.view());
    }
    void reserve(std::size_t pairCapacity) override { lists_.reserve(pairCapacity); }
    std::size_t bytes() const override { return lists_.bytes() + counts_.bytes(); }

    static std::size_t predictedBytes(std::size_t bodyCount, std::size_t pairCapacity) {
        return ContactLists::predictedBytes(bodyCount, pairCapacity) +
               bodyCount * sizeof(ContactCounts);
    }

private:
    Device device_;
    ContactLists lists_;
    DeviceBuffer<ContactCounts> counts_;
};

}  // namespace ballpit
