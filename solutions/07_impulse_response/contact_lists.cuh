// Chapter 07: from the list of pairs to "who touches me?" for every body.
//
// The pair list names each pair at its first body only. A body that gathers its own impulses also
// needs the pairs in which it is second: its incoming partners. They are collected with integer
// atomics, whose order changes from run to run, and then sorted, which takes the order out again.
#pragma once

#include "common/atomics.cuh"
#include "common/launch.cuh"
#include "common/response.h"

namespace ballpit {

/// All contacts of every body. Partners of body i before it: incoming[incomingStarts[i]...];
/// partners after it: the second bodies of its own pairs. Together they are in rising order.
struct ContactsView {
    PairsView pairs;
    View<std::uint32_t> incomingStarts;
    View<std::uint32_t> incoming;
};

/// Calls visit(j) for each partner j of body i in rising order: a fixed order of summation.
template <class Visit>
HD void visitPartners(int i, const ContactsView& contacts, Visit visit) {
    for (std::uint32_t k = contacts.incomingStarts[i]; k < contacts.incomingStarts[i + 1]; ++k)
        visit(contacts.incoming[k]);
    for (std::uint32_t k = contacts.pairs.starts[i]; k < contacts.pairs.endOf(i); ++k)
        visit(contacts.pairs.pairs[k].second);
}

/// Body i counts itself in at each partner after it. A full pair list is cut short by endOf; the
/// step is then redone, and its numbers do not matter.
HD inline void countIncoming(int i, PairsView pairs, View<std::uint32_t> incomingCounts) {
    for (std::uint32_t k = pairs.starts[i]; k < pairs.endOf(i); ++k)
        fetchAdd(incomingCounts[pairs.pairs[k].second], 1);
}

/// Body i writes itself into the list of each partner after it, and counts the counters back to
/// zero, ready for the next round.
HD inline void listIncoming(int i, ContactsView contacts, View<std::uint32_t> incomingCounts) {
    for (std::uint32_t k = contacts.pairs.starts[i]; k < contacts.pairs.endOf(i); ++k) {
        const std::uint32_t partner = contacts.pairs.pairs[k].second;
        const std::uint32_t place = fetchSubtract(incomingCounts[partner], 1) - 1u;
        contacts.incoming[contacts.incomingStarts[partner] + place] = static_cast<std::uint32_t>(i);
    }
}

/// Insertion sort of body i's incoming partners: a handful of numbers that are nearly in order.
HD inline void sortIncoming(int i, const ContactsView& contacts) {
    const std::uint32_t begin = contacts.incomingStarts[i], end = contacts.incomingStarts[i + 1];
    for (std::uint32_t k = begin + 1; k < end; ++k) {
        const std::uint32_t partner = contacts.incoming[k];
        std::uint32_t hole = k;
        for (; hole > begin && contacts.incoming[hole - 1] > partner; --hole)
            contacts.incoming[hole] = contacts.incoming[hole - 1];
        contacts.incoming[hole] = partner;
    }
}

/// Owns the incoming lists of `bodyCount` bodies.
class ContactLists {
public:
    ContactLists(Device device, std::size_t bodyCount, std::size_t pairCapacity)
        : counts_(device, bodyCount, "incomingCounts"),
          starts_(device, bodyCount + 1, "incomingStarts"),
          incoming_(device, pairCapacity, "incoming") {
        counts_.fill(0);
    }

    /// Collects the lists; each body's incoming partners still unsorted.
    ContactsView collect(int bodyCount, PairsView pairs, Scratch& scratch) {
        const Device device = counts_.device();
        const ContactsView contacts{pairs, starts_.view(), incoming_.view()};
        launch<countIncoming>(device, bodyCount, pairs, counts_.view());
        exclusiveScan(device, bodyCount, counts_.data(), starts_.data(), scratch);
        launch<listIncoming>(device, bodyCount, contacts, counts_.view());
        return contacts;
    }

    void reserve(std::size_t pairCapacity) { incoming_.resize(pairCapacity); }
    std::size_t bytes() const { return counts_.bytes() + starts_.bytes() + incoming_.bytes(); }

private:
    DeviceBuffer<std::uint32_t> counts_, starts_, incoming_;
};

}  // namespace ballpit
