// Chapter 11: how much of its impulse a contact may keep when it is not alone.
//
// The plain sum asks every contact for the impulse of a lone pair, J = -(1 + e) v_n m_eff with
// m_eff = 1 / (1/m_a + 1/m_b). A body with n contacts that enters each with 1/n of its mass has
// n/m for 1/m: chapter 07's mass splitting. So that is the plain sum again, times a share:
//     share = m_eff(split) / m_eff(alone) = (1/m_a + 1/m_b) / (n_a/m_a + n_b/m_b),
// 1 for a lone pair, about 1/n among n. Both bodies must use the same share: were it 1/n_a for one
// and 1/n_b for the other, momentum would come from nowhere.
#pragma once

#include "07_impulse_response/impulse_response.cuh"
#include "common/hole.cuh"

namespace ballpit {

/// The share of a lone pair's impulse (or push) that bodies with so many contacts leave it.
HD inline float splitShare(float inverseMassA, float contactsA, float inverseMassB,
                           float contactsB) {
    // ---- hole split.share (about 3 lines): The effective mass of the split masses over that of the whole ones
    TODO_HOLE("split.share");
    return 1.0f;
    // ---- end of split.share
}

/// For each of its pairs: reduces impulse and push, computed as if it were alone, to its share.
HD inline void splitAmongContacts(int thread, BodiesView bodies, ImpulseView view) {
    visitPairsOfThread(thread, view.contacts.pairs, [&](std::uint32_t k) {
        const auto [a, b] = view.contacts.pairs.pairs[k];
        const float inverseMassA = bodies.velocities[a].w, inverseMassB = bodies.velocities[b].w;
        const ContactCounts countsA = view.counts[a], countsB = view.counts[b];
        // Without an impulse the counts of approaching contacts may be 0.
        float& impulse = view.normalsAndImpulses[k].w;
        if (impulse != 0.0f)
            impulse *= splitShare(inverseMassA, countsA.approaching(), inverseMassB,
                                  countsB.approaching());
        view.pushes[k] *=
            splitShare(inverseMassA, countsA.touching(), inverseMassB, countsB.touching());
    });
}

}  // namespace ballpit
