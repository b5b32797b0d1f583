// The lesson's worked colouring: six balls, seven contacts, and the round in which each contact
// gets its colour.
#pragma once

#include <vector>

#include "11_stability/colouring.cuh"
#include "common/findings.h"
#include "common/one_round.cuh"

namespace ballpit {

/// Six balls in two rows, as a triangle that stands on its head beside one that does not.
inline const std::vector<Pair>& exampleContacts() {
    static const std::vector<Pair> contacts{{0, 1}, {0, 3}, {1, 2}, {1, 3}, {1, 4}, {2, 4}, {3, 4}};
    return contacts;
}

/// Priority, colour and round of each contact, for the figure. On the CPU: they are the same
/// everywhere.
inline void tellExample(Findings& findings) {
    const std::vector<Pair>& contacts = exampleContacts();
    Spheres balls;
    for (int k = 0; k < 5; ++k) balls.add({}, {}, 0.5f, 1.0f, 1.0f);
    OneRound bodies(Device::cpu, balls, contacts);
    Colouring colouring(Device::cpu, balls.count(), contacts.size());
    colouring.colour(bodies.round().pairs, true);
    const ColouringView view = colouring.view();
    const PriorityHash hash = PriorityHash::forCount(static_cast<std::uint32_t>(contacts.size()));
    std::vector<std::uint32_t> ends, priorities, colours, rounds(contacts.size(), 0);
    for (std::uint32_t k = 0; k < contacts.size(); ++k) {
        ends.insert(ends.end(), {contacts[k].first, contacts[k].second});
        priorities.push_back(hash.priorityOf(k));
        colours.push_back(view.colours[k]);
    }
    launch<clearBodyColours>(Device::cpu, 5, view);
    launch<clearPairColours>(Device::cpu, 5, 5, view);
    for (std::uint32_t round = 1; round <= contacts.size(); ++round) {
        launch<bidForColour>(Device::cpu, 5, 5, view);
        launch<takeColour>(Device::cpu, 5, 5, view);
        for (std::size_t k = 0; k < contacts.size(); ++k)
            if (rounds[k] == 0 && view.colours[k] != noColour) rounds[k] = round;
    }
    findings.list("example contacts", ends);
    findings.list("example priorities", priorities);
    findings.list("example colours", colours);
    findings.list("example rounds", rounds);
}

}  // namespace ballpit
