// Chapter 11: the plain sum. Every pair's impulse is computed from the bodies as they were, as if
// there were no other pair; every body adds up those of its contacts, times a relaxation factor.
//
// Momentum is kept, and the bits are the same everywhere: the sum is gathered in a fixed order, as
// chapter 07's. What is not kept is energy: k contacts that push a ball at once push it k times,
// and nobody notices until the next round. (A hub that meets k spokes at rest at an angle of cosine
// c is safe only while (1 + e)(1 + B (k c^2 - 1)) <= 2, B = m_spoke / (m_spoke + m_hub).)
//
// Where it holds: thin gases, and dull balls (e <= 0.5). Where it fails: a dense elastic gas
// explodes, and no step is small enough to prevent it; a relaxation below 1 trades that for balls
// that bounce too little.
#pragma once

#include "11_stability/contact_rules.cuh"
#include "11_stability/effective_mass.cuh"

namespace ballpit {

/// For each of its pairs: impulse and push, as if there were no other.
HD inline void computePairAlone(int thread, BodiesView bodies, ImpulseView view,
                                ContactRules rules) {
    visitPairsOfThread(thread, view.contacts.pairs, [&](std::uint32_t k) {
        const auto [a, b] = view.contacts.pairs.pairs[k];
        const NormalEffect effect = effectUnder(rules, a, b, bodies);
        view.normalsAndImpulses[k] = withW(effect.normal, effect.impulse);
        view.pushes[k] = effect.push;
    });
}

/// Chapter 07's linking and gathering, without its splitting; or, as an exhibit, with it
/// (`splitMasses`): then it is chapter 07's response in other words.
class JacobiResponse : public Response {
public:
    JacobiResponse(Device device, std::size_t bodyCount, std::size_t pairCapacity,
                   const ContactRules& rules, bool splitMasses = false)
        : device_(device),
          rules_(rules),
          splitMasses_(splitMasses),
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
        launch<computePairAlone>(device_, round.bodyCount, round.from, view, rules_);
        if (splitMasses_) launch<splitAmongContacts>(device_, round.bodyCount, round.from, view);
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

private:
    Device device_;
    ContactRules rules_;
    bool splitMasses_;
    ContactLists lists_;
    DeviceBuffer<ContactCounts> counts_;
    DeviceBuffer<Vec4> normalsAndImpulses_;
    DeviceBuffer<float> pushes_;
};

}  // namespace ballpit
