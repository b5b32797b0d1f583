// Chapter 07: from the list of pairs to "who touches me?" for every body.
//
// The pair list names each pair at its first body only. A body that gathers its own impulses also
// needs the pairs in which it is second: its incoming pairs. They are strung on a linked list for
// each body, with one integer atomic a pair. The order on the string changes from run to run;
// sorting it takes the order out again.
#pragma once

#include "common/atomics.cuh"
#include "common/launch.cuh"
#include "common/response.h"

namespace ballpit {

/// End of a string. Larger than any pair's number, so a sorted string ends where it should.
constexpr std::uint32_t noPair = 0xFFFFFFFFu;

/// All contacts of every body. Pairs with body i second: firstIncoming[i], then nextIncoming[] of
/// that, and so on to noPair. Pairs with body i first: in the pair list.
struct ContactsView {
    PairsView pairs;
    View<std::uint32_t> firstIncoming;
    View<std::uint32_t> nextIncoming;
};

/// Body i hangs each of its pairs on the string of the pair's second body. A full pair list is cut
/// short by endOf; the step is then redone, and its numbers do not matter.
HD inline void linkIncoming(int i, ContactsView contacts) {
    for (std::uint32_t k = contacts.pairs.starts[i]; k < contacts.pairs.endOf(i); ++k) {
        const std::uint32_t partner = contacts.pairs.pairs[k].second;
        contacts.nextIncoming[k] = exchange(contacts.firstIncoming[partner], k);
    }
}

/// Insertion sort of body i's string by pair number: takes it apart, and hangs each pair where the
/// numbers before it are smaller. Only body i's own links are touched.
HD inline void sortIncoming(int i, const ContactsView& contacts) {
    std::uint32_t pair = contacts.firstIncoming[i];
    std::uint32_t first = noPair;
    while (pair != noPair) {
        const std::uint32_t rest = contacts.nextIncoming[pair];
        std::uint32_t* link = &first;
        while (*link < pair) link = &contacts.nextIncoming[*link];
        contacts.nextIncoming[pair] = *link;
        *link = pair;
        pair = rest;
    }
    contacts.firstIncoming[i] = first;
}

/// Calls visit(j) for each partner j of body i in rising order: a fixed order of summation. Pair
/// numbers rise with their first body, so a sorted string gives the partners before i in order.
template <class Visit>
HD void visitPartners(int i, const ContactsView& contacts, Visit visit) {
    for (std::uint32_t k = contacts.firstIncoming[i]; k != noPair; k = contacts.nextIncoming[k])
        visit(contacts.pairs.pairs[k].first);
    for (std::uint32_t k = contacts.pairs.starts[i]; k < contacts.pairs.endOf(i); ++k)
        visit(contacts.pairs.pairs[k].second);
}

/// Owns the strings of `bodyCount` bodies. Between two uses every string is empty.
class ContactLists {
public:
    ContactLists(Device device, std::size_t bodyCount, std::size_t pairCapacity)
        : firstIncoming_(device, bodyCount, "firstIncoming"),
          nextIncoming_(device, pairCapacity, "nextIncoming") {
        firstIncoming_.fill(0xFF);
    }

    /// Hangs all pairs on their strings, still unsorted. Who uses the strings empties them.
    ContactsView link(int bodyCount, PairsView pairs) {
        const ContactsView contacts{pairs, firstIncoming_.view(), nextIncoming_.view()};
        launch<linkIncoming>(firstIncoming_.device(), bodyCount, contacts);
        return contacts;
    }

    void reserve(std::size_t pairCapacity) { nextIncoming_.resize(pairCapacity); }
    std::size_t bytes() const { return firstIncoming_.bytes() + nextIncoming_.bytes(); }
    static std::size_t predictedBytes(std::size_t bodyCount, std::size_t pairCapacity) {
        return (bodyCount + pairCapacity) * sizeof(std::uint32_t);
    }

private:
    DeviceBuffer<std::uint32_t> firstIncoming_, nextIncoming_;
};

}  // namespace ballpit
