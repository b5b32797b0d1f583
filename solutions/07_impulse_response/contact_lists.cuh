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

/// Hangs pair k on the string of its second body.
HD inline void linkIncoming(std::uint32_t k, const ContactsView& contacts) {
    const std::uint32_t partner = contacts.pairs.pairs[k].second;
    contacts.nextIncoming[k] = exchange(contacts.firstIncoming[partner], k);
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

/// Calls visit(pair number, sign) for each contact of body i, in rising order of the partner's
/// slot: a fixed order of summation. Sign is +1 where body i is second, -1 where it is first: the
/// direction in which the pair's impulse acts on it.
template <class Visit>
HD void visitContacts(int i, const ContactsView& contacts, Visit visit) {
    // Pair numbers rise with their first body, so a sorted string gives partners in order.
    for (std::uint32_t k = contacts.firstIncoming[i]; k != noPair; k = contacts.nextIncoming[k])
        visit(k, 1.0f);
    for (std::uint32_t k = contacts.pairs.starts[i]; k < contacts.pairs.endOf(i); ++k)
        visit(k, -1.0f);
}

/// Owns the strings of `bodyCount` bodies. Between two uses every string is empty: whoever reads a
/// string empties it.
class ContactLists {
public:
    ContactLists(Device device, std::size_t bodyCount, std::size_t pairCapacity)
        : firstIncoming_(device, bodyCount, "firstIncoming"),
          nextIncoming_(device, pairCapacity, "nextIncoming") {
        firstIncoming_.fill(0xFF);
    }

    ContactsView view(PairsView pairs) {
        return {pairs, firstIncoming_.view(), nextIncoming_.view()};
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
