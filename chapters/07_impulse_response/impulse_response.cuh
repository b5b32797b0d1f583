// Chapter 07: the engine's default response: impulses and position corrections, gathered per body.
//
// Every pair's impulse is computed once, by one thread; every body then adds up those of its
// contacts, in a fixed order, and writes only itself: no atomics on floats, the same bits on every
// machine. A plain sum of the pair impulses would push a ball with several contacts too hard (one
// elastic ball into a pocket of three leaves with three times its energy). So masses are split
// (Tonge, Benevolenski and Voroshilov, "Mass splitting for jitter-free parallel rigid body
// simulation", SIGGRAPH 2012): a body with n contacts enters each of them with 1/n of its mass.
// Both partners get the same impulse, so momentum is conserved, and kinetic energy never grows.
// The split of velocities counts only approaching contacts: the others need no share.
//
// Where it fails: it gives each contact too little, so a deep pile sinks into itself and a dense
// elastic gas loses energy. Chapters 11 and 12 show where, and what to use there.
#pragma once

#include "07_impulse_response/contact.cuh"
#include "07_impulse_response/contact_lists.cuh"
#include "common/atomics.cuh"
#include "common/hole.cuh"
#include "common/response.h"

namespace ballpit {

/// How many contacts a body has, and in how many of them it approaches its partner. Counted in one
/// 64-bit number, so that both are added at once: touching in the upper half.
struct ContactCounts {
    unsigned long long packed = 0;

    HD static ContactCounts one(bool isApproaching) {
        return {(1ull << 32) | (isApproaching ? 1ull : 0ull)};
    }
    HD float touching() const { return static_cast<float>(packed >> 32); }
    HD float approaching() const { return static_cast<float>(packed & 0xFFFFFFFFull); }
};

/// What the kernels of a round share. Impulse and push act along the normal on a pair's second body
/// and in the opposite direction on its first; divided by a body's mass they change its velocity
/// and its position.
struct ImpulseView {
    ContactsView contacts;
    View<ContactCounts> counts;
    View<Vec4> normalsAndImpulses;  ///< a pair: unit normal from first to second; N s
    View<float> pushes;             ///< a pair: kg m
};

/// Thread t's share of the pairs: t, t + bodyCount, ... Threads as many as bodies, since the host
/// does not know how many pairs the device has found.
template <class Visit>
HD void visitPairsOfThread(int thread, const PairsView& pairs, Visit visit) {
    const std::uint32_t bodyCount = pairs.starts.count - 1u, stored = pairs.stored();
    for (std::uint32_t k = static_cast<std::uint32_t>(thread); k < stored; k += bodyCount) visit(k);
}

/// For each of its pairs: hangs it on its second body's string, and counts it at both bodies.
HD inline void linkAndCount(int thread, BodiesView bodies, ImpulseView view) {
    visitPairsOfThread(thread, view.contacts.pairs, [&](std::uint32_t k) {
        linkIncoming(k, view.contacts);
        const auto [a, b] = view.contacts.pairs.pairs[k];
        const Vec3 line = lineOfCentres(a, b, bodies);
        const ContactCounts one = ContactCounts::one(
            separationAlong(line, bodies.velocities[a], bodies.velocities[b]) < 0.0f);
        add(view.counts[a].packed, one.packed);
        add(view.counts[b].packed, one.packed);
    });
}

/// For each of its pairs: the impulse and the push. A body of inverse mass 1/m that splits among n
/// contacts has the inverse mass n/m in each of them.
HD inline void computePairImpulse(int thread, BodiesView bodies, ImpulseView view) {
    visitPairsOfThread(thread, view.contacts.pairs, [&](std::uint32_t k) {
        const auto [a, b] = view.contacts.pairs.pairs[k];
        const float inverseMassA = bodies.velocities[a].w, inverseMassB = bodies.velocities[b].w;
        const ContactCounts countsA = view.counts[a], countsB = view.counts[b];
        const Contact contact = contactBetween(a, b, bodies);

        float impulse = 0.0f, push = 0.0f;
        // ---- hole response.split (about 8 lines): As one contact, but each inverse mass times its contacts
        TODO_HOLE("response.split");
        // ---- end of response.split
        view.normalsAndImpulses[k] = withW(contact.normal, impulse);
        view.pushes[k] = push;
    });
}

/// Adds up what all contacts do to body i, and writes its new velocity and position to `to`. Also
/// empties its string and its counts for the next round.
HD inline void collisionResponse(int i, ResponseRound round, ImpulseView view) {
    sortIncoming(i, view.contacts);
    const Vec4 sphere = round.from.positions[i], moving = round.from.velocities[i];
    const float inverseMass = moving.w;
    Vec3 velocityChange, positionChange;
    visitContacts(i, view.contacts, [&](std::uint32_t k, float sign) {
        const Vec4 pair = view.normalsAndImpulses[k];
        // ---- hole response.gather (about 2 lines): Add pair k's share in this body's velocity and position
        TODO_HOLE("response.gather");
        // ---- end of response.gather
    });
    view.contacts.firstIncoming[i] = noPair;
    view.counts[i] = ContactCounts{};

    const Vec3 position = xyz(sphere) + positionChange, velocity = xyz(moving) + velocityChange;
    round.to.positions[i] = withW(position, sphere.w);
    round.to.velocities[i] = withW(velocity, inverseMass);
    reportMotion(i, round, positionChange, position, velocity);
}

/// Mass-split impulses, gathered.
class ImpulseResponse : public Response {
public:
    ImpulseResponse(Device device, std::size_t bodyCount, std::size_t pairCapacity)
        : device_(device),
          lists_(device, bodyCount, pairCapacity),
          counts_(device, bodyCount, "contactCounts"),
          normalsAndImpulses_(device, pairCapacity, "pairImpulses"),
          pushes_(device, pairCapacity, "pairPushes") {
        counts_.fill(0);
    }

    void resolve(const ResponseRound& round) override {
        const ImpulseView view{lists_.view(round.pairs), counts_.view(), normalsAndImpulses_.view(),
                               pushes_.view()};
        launch<linkAndCount>(device_, round.bodyCount, round.from, view);
        launch<computePairImpulse>(device_, round.bodyCount, round.from, view);
        launch<collisionResponse>(device_, round.bodyCount, round, view);
    }
    void reserve(std::size_t pairCapacity) override {
        lists_.reserve(pairCapacity);
        normalsAndImpulses_.resize(pairCapacity);
        pushes_.resize(pairCapacity);
    }
    std::size_t bytes() const override {
        return lists_.bytes() + counts_.bytes() + normalsAndImpulses_.bytes() + pushes_.bytes();
    }

    static std::size_t predictedBytes(std::size_t bodyCount, std::size_t pairCapacity) {
        return ContactLists::predictedBytes(bodyCount, pairCapacity) +
               bodyCount * sizeof(ContactCounts) + pairCapacity * (sizeof(Vec4) + sizeof(float));
    }

private:
    Device device_;
    ContactLists lists_;
    DeviceBuffer<ContactCounts> counts_;
    DeviceBuffer<Vec4> normalsAndImpulses_;
    DeviceBuffer<float> pushes_;
};

}  // namespace ballpit
