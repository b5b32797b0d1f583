// Chapter 11: colours for the pairs, so that no two pairs of a colour share a body. Pairs of a
// colour can then be resolved at the same time, in place, by any number of threads.
//
// The colours are those that one thread would give which takes the pairs in order of their priority
// and gives each the first colour that is free at both its bodies. A GPU gets the same in rounds
// (Jones and Plassmann 1993): a pair takes its colour once all pairs of its two bodies that come
// before it have theirs. The priorities are hashed pair numbers, so chains of pairs that wait for
// each other stay short. Only integers are compared, so the colours are the same on every machine.
//
// A body with very many contacts (a hub) needs more colours or rounds than there are. What is left
// over gets the overflow colour: one thread resolves it, pair by pair, in order of their numbers.
#pragma once

#include <algorithm>

#include "common/algorithms.h"
#include "common/atomics.cuh"
#include "common/hole.cuh"
#include "common/launch.cuh"
#include "common/pair_list.cuh"

namespace ballpit {

/// Equal balls touch at most 12 others each, and two such bodies block at most 22 colours.
constexpr int colourCount = 24;
/// Rounds after which pairs still without a colour overflow. Millions of equal balls need about 30.
constexpr int colouringRounds = 48;
constexpr std::uint32_t overflowColour = colourCount, noColour = colourCount + 1;

/// On a GPU, one block does all colours of so many bodies and fewer, and all rounds of colouring: a
/// launch for each takes longer than its few pairs.
constexpr std::size_t oneBlockMost = 2048;

/// What colours are gone at a body (bit c: colour c), and the last round in which a pair of it got
/// its colour. A round past the last means: some pair of this body overflowed for want of rounds.
struct BodyColours {
    std::uint32_t used, round;
};

/// Colour c has the pairs lists[c * stride] to lists[c * stride + counts[c] - 1], in any order; a
/// colour cannot have more pairs than half the bodies (`stride`). The overflow's pairs are in
/// `overflow`, in rising order, overflowStarts[stored] of them.
struct ColouringView {
    PairsView pairs;
    View<std::uint32_t> colours;  ///< by pair
    View<BodyColours> bodies;
    View<std::uint32_t> best;  ///< by body: the smallest priority of its pairs without a colour
    View<std::uint32_t> lists, counts;
    View<std::uint32_t> overflowFlags, overflowStarts, overflow;
    std::uint32_t stride;
};

/// The hash that is a pair's priority: a permutation of all numbers below 2^bits, made of steps
/// that can each be undone.
struct PriorityHash {
    std::uint32_t mask;
    int shift;

    HD static PriorityHash forCount(std::uint32_t count) {
        int bits = 1;
        while (bits < 32 && (count - 1u) >> bits) ++bits;
        return {bits == 32 ? 0xFFFFFFFFu : (1u << bits) - 1u, (bits + 1) / 2};
    }
    HD std::uint32_t priorityOf(std::uint32_t pair) const {
        std::uint32_t p = (pair * 0x9E3779B1u) & mask;
        p ^= p >> shift;
        return (p * 0x85EBCA6Bu) & mask;
    }
    /// The other way: 0x0E8B2F51 and 0xA5CB9243 are the inverses of the two factors modulo 2^32.
    HD std::uint32_t pairWith(std::uint32_t priority) const {
        std::uint32_t p = (priority * 0xA5CB9243u) & mask;
        p ^= p >> shift;
        return (p * 0x0E8B2F51u) & mask;
    }
};

/// Gives pair k its colour; all pairs of its bodies that come before it have theirs.
HD inline void giveColour(std::uint32_t k, const ColouringView& view) {
    const auto [a, b] = view.pairs.pairs[k];
    BodyColours &atA = view.bodies[a], &atB = view.bodies[b];
    const std::uint32_t round = (atA.round > atB.round ? atA.round : atB.round) + 1u;
    std::uint32_t colour = overflowColour;
    if (round <= colouringRounds) {
        // ---- hole colour.give (about 7 lines): The first colour free at both bodies; then it is used at both
        TODO_HOLE("colour.give");
        // ---- end of colour.give
    }
    atA.round = atB.round = round;
    view.colours[k] = colour;
}

/// One thread takes all pairs in order of their priority.
HD inline void colourInOrder(int, ColouringView view) {
    const std::uint32_t stored = view.pairs.stored();
    const PriorityHash hash = PriorityHash::forCount(stored);
    if (stored == 0) return;
    for (std::uint32_t priority = 0; priority <= hash.mask; ++priority) {
        const std::uint32_t k = hash.pairWith(priority);
        if (k < stored) giveColour(k, view);
    }
}

/// Calls visit(k) for the pairs k of thread `thread` of `threads`.
template <class Visit>
HD void visitShare(int thread, int threads, const PairsView& pairs, Visit visit) {
    const std::uint32_t stored = pairs.stored();
    for (std::uint32_t k = static_cast<std::uint32_t>(thread); k < stored;
         k += static_cast<std::uint32_t>(threads))
        visit(k);
}

HD inline void clearBodyColours(int i, ColouringView view) {
    view.bodies[i] = {0, 0};
    view.best[i] = 0xFFFFFFFFu;
}
HD inline void clearCount(int colour, ColouringView view) { view.counts[colour] = 0; }

HD inline void clearPairColours(int thread, int threads, ColouringView view) {
    visitShare(thread, threads, view.pairs, [&](std::uint32_t k) { view.colours[k] = noColour; });
}

/// First half of a round: every pair without a colour bids at both its bodies.
HD inline void bidForColour(int thread, int threads, ColouringView view) {
    const PriorityHash hash = PriorityHash::forCount(view.pairs.stored());
    visitShare(thread, threads, view.pairs, [&](std::uint32_t k) {
        if (view.colours[k] != noColour) return;
        const auto [a, b] = view.pairs.pairs[k];
        // ---- hole colour.bid (about 2 lines): Bid the pair's priority at both its bodies; the smallest stays
        TODO_HOLE("colour.bid");
        // ---- end of colour.bid
    });
}

/// Second half: those that come first at both take their colour. No two of them share a body.
HD inline void takeColour(int thread, int threads, ColouringView view) {
    const PriorityHash hash = PriorityHash::forCount(view.pairs.stored());
    visitShare(thread, threads, view.pairs, [&](std::uint32_t k) {
        if (view.colours[k] != noColour) return;
        const auto [a, b] = view.pairs.pairs[k];
        const std::uint32_t priority = hash.priorityOf(k);
        // ---- hole colour.take (about 3 lines): Who won at both bodies takes its colour and clears both bids
        TODO_HOLE("colour.take");
        // ---- end of colour.take
    });
}

/// Has a pair of a thread's share no colour yet?
HD inline bool lacksColours(int thread, int threads, const ColouringView& view) {
    bool lacks = false;
    visitShare(thread, threads, view.pairs,
               [&](std::uint32_t k) { lacks = lacks || view.colours[k] == noColour; });
    return lacks;
}

/// All rounds as phases (launchPhases): no pair has a colour; then bids and takes in turn, until
/// nobody bids.
HD inline bool phaseOfColouring(int phase, int thread, int threads, const ColouringView& view) {
    if (phase == 0) {
        clearPairColours(thread, threads, view);
    } else if (phase % 2) {
        if (!lacksColours(thread, threads, view)) return false;
        bidForColour(thread, threads, view);
    } else {
        takeColour(thread, threads, view);
    }
    return true;
}
constexpr int colouringPhases = 1 + 2 * colouringRounds;

/// Writes each pair to its colour's list. The place in it is a matter of chance, but the pairs of a
/// colour do not touch the same bodies, so their order cannot show. Flags what overflows.
HD inline void listColours(int thread, int threads, ColouringView view) {
    visitShare(thread, threads, view.pairs, [&](std::uint32_t k) {
        const std::uint32_t colour = view.colours[k];
        if (colour < colourCount)
            view.lists[colour * view.stride + fetchAdd(view.counts[colour], 1u)] = k;
    });
}

/// 1 for the pairs that overflow, for all places of the list.
HD inline void flagOverflow(int k, ColouringView view) {
    const auto pair = static_cast<std::uint32_t>(k);
    view.overflowFlags[k] =
        pair < view.pairs.stored() && view.colours[k] >= overflowColour ? 1u : 0u;
}

HD inline void listOverflow(int k, ColouringView view) {
    if (view.overflowFlags[k])
        view.overflow[view.overflowStarts[k]] = static_cast<std::uint32_t>(k);
}

/// body(k, arguments...) for the place-th pair k of a colour. (What a body takes by reference is
/// not copied for each pair: on a CPU that would take as long as the pair itself.)
template <auto body, class... Args>
HD void pairOfColour(int place, std::uint32_t colour, const ColouringView& view,
                     const Args&... args) {
    if (static_cast<std::uint32_t>(place) < view.counts[colour])
        body(view.lists[colour * view.stride + static_cast<std::uint32_t>(place)], args...);
}

/// The same for all pairs that overflow, one after the other.
template <auto body, class... Args>
HD void pairsOfOverflow(int, const ColouringView& view, const Args&... args) {
    const std::uint32_t count = view.overflowStarts[view.overflowFlags.count];
    for (std::uint32_t place = 0; place < count; ++place) body(view.overflow[place], args...);
}

/// A thread's share of the pairs of a colour (launchPhases). The first colour without pairs is the
/// last, since each pair took the first that was free; then come those that overflow.
template <auto body, class... Args>
HD bool shareOfColour(int colour, int thread, int threads, const ColouringView& view,
                      const Args&... args) {
    const auto c = static_cast<std::uint32_t>(colour);
    if (c == colourCount || view.counts[c] == 0) {
        if (thread == 0) pairsOfOverflow<body, Args...>(0, view, args...);
        return false;
    }
    for (int place = thread; place < static_cast<int>(view.counts[c]); place += threads)
        pairOfColour<body, Args...>(place, c, view, args...);
    return true;
}

/// Owns the colours of up to `pairCapacity` pairs of `bodyCount` bodies.
class Colouring {
public:
    Colouring(Device device, std::size_t bodyCount, std::size_t pairCapacity)
        : device_(device),
          bodies_(device, bodyCount, "bodyColours"),
          best_(device, bodyCount, "bestPriorities"),
          lists_(device, colourCount * largestColour(bodyCount), "colourLists"),
          counts_(device, colourCount, "colourCounts"),
          colours_(device, pairCapacity, "pairColours"),
          overflowFlags_(device, pairCapacity, "overflowFlags"),
          overflowStarts_(device, pairCapacity + 1, "overflowStarts"),
          overflow_(device, pairCapacity, "overflowPairs"),
          scratch_(device, 0, "scratch") {}

    void reserve(std::size_t pairCapacity) {
        colours_.resize(pairCapacity);
        overflowFlags_.resize(pairCapacity);
        overflowStarts_.resize(pairCapacity + 1);
        overflow_.resize(pairCapacity);
    }

    /// Colours the pairs. `inRounds`: as a GPU does it, also on a CPU.
    void colour(const PairsView& pairs, bool inRounds) {
        view_ = {pairs,
                 colours_.view(),
                 bodies_.view(),
                 best_.view(),
                 lists_.view(),
                 counts_.view(),
                 overflowFlags_.view(),
                 overflowStarts_.view(),
                 overflow_.view(),
                 static_cast<std::uint32_t>(largestColour(bodies_.count()))};
        const int bodyCount = static_cast<int>(bodies_.count());
        launch<clearBodyColours>(device_, bodyCount, view_);
        launch<clearCount>(device_, colourCount, view_);
        inRounds ? colourInRounds(bodyCount) : launch<colourInOrder>(device_, 1, view_);
        const int threads = inRounds ? bodyCount : 1;
        launch<listColours>(device_, threads, threads, view_);
        listWhatOverflows();
    }
    void colour(const PairsView& pairs) { colour(pairs, device_ == Device::cuda); }

    /// Runs body(k, arguments...) for every pair k: colour after colour, the pairs of a colour at
    /// the same time, and the overflow last.
    template <auto body, class... Args>
    void forEachPair(Args... args) {
        if (isOneBlockEnough())
            return launchPhases<shareOfColour<body, Args...>>(device_, colourCount + 1, view_,
                                                              args...);
        for (std::uint32_t colour = 0; colour < colourCount; ++colour)
            if (const int most = mostPairsOf(colour))
                launch<pairOfColour<body, Args...>>(device_, most, colour, view_, args...);
        launch<pairsOfOverflow<body, Args...>>(device_, 1, view_, args...);
    }

    const ColouringView& view() const { return view_; }
    std::size_t bytes() const {
        return bodies_.bytes() + best_.bytes() + lists_.bytes() + counts_.bytes() +
               colours_.bytes() + overflowFlags_.bytes() + overflowStarts_.bytes() +
               overflow_.bytes();
    }
    static std::size_t predictedBytes(std::size_t bodyCount, std::size_t pairCapacity) {
        return bodyCount * (sizeof(BodyColours) + sizeof(std::uint32_t) * (1 + colourCount / 2)) +
               4 * sizeof(std::uint32_t) * pairCapacity;
    }

private:
    static std::size_t largestColour(std::size_t bodyCount) {
        return std::max<std::size_t>(1, bodyCount / 2);
    }

    bool isOneBlockEnough() const {
        return device_ == Device::cuda && bodies_.count() <= oneBlockMost;
    }

    void colourInRounds(int threads) {
        if (isOneBlockEnough())
            return launchPhases<phaseOfColouring>(device_, colouringPhases, view_);
        launch<clearPairColours>(device_, threads, threads, view_);
        for (int round = 0; round < colouringRounds; ++round) {
            launch<bidForColour>(device_, threads, threads, view_);
            launch<takeColour>(device_, threads, threads, view_);
        }
    }

    void listWhatOverflows() {
        const int places = static_cast<int>(overflowFlags_.count());
        launch<flagOverflow>(device_, places, view_);
        exclusiveScan(device_, places, overflowFlags_.data(), overflowStarts_.data(), scratch_);
        launch<listOverflow>(device_, places, view_);
    }

    /// Threads for a colour. The CPU's memory can be read here and now; a GPU gets as many as the
    /// largest colour possible would need.
    int mostPairsOf(std::uint32_t colour) const {
        return static_cast<int>(device_ == Device::cpu ? view_.counts[colour] : view_.stride);
    }

    Device device_;
    ColouringView view_;
    DeviceBuffer<BodyColours> bodies_;
    DeviceBuffer<std::uint32_t> best_, lists_, counts_;
    DeviceBuffer<std::uint32_t> colours_, overflowFlags_, overflowStarts_, overflow_;
    Scratch scratch_;
};

}  // namespace ballpit
