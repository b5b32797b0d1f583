// The list of touching pairs: what a broad phase writes and a response reads.
#pragma once

#include <cstdint>

#include "common/buffer.cuh"

namespace ballpit {

/// Two touching bodies, as slots; first < second, so each pair has one spelling.
struct Pair {
    std::uint32_t first, second;
};

HD inline bool operator==(Pair a, Pair b) { return a.first == b.first && a.second == b.second; }
HD inline bool operator<(Pair a, Pair b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
}

/// The pairs whose first body is i are pairs[starts[i]] to pairs[starts[i + 1] - 1]. When more
/// were found than fit, `starts` still counts all, and only those below pairs.count are stored.
struct PairsView {
    View<Pair> pairs;
    View<std::uint32_t> starts;

    /// How many pairs are stored.
    HD std::uint32_t stored() const {
        const std::uint32_t found = starts[starts.count - 1];
        return found < pairs.count ? found : pairs.count;
    }

    /// One past the last stored pair of body i.
    HD std::uint32_t endOf(int i) const {
        const std::uint32_t end = starts[i + 1];
        return end < pairs.count ? end : pairs.count;
    }
};

/// How many partners of a body the search remembers, so that most pairs are searched for once.
constexpr std::uint32_t rememberedPartners = 8;

/// Owns the pair list of `bodyCount` bodies and the arrays of its count-scan-fill.
class PairList {
public:
    PairList(Device device, std::size_t bodyCount, std::size_t capacity)
        : pairs(device, capacity, "pairs"),
          starts(device, bodyCount + 1, "pairStarts"),
          counts(device, bodyCount, "pairCounts"),
          remembered(device, bodyCount * rememberedPartners, "rememberedPartners") {
        starts.fill(0);  // no pairs before the first search
    }

    PairsView view() { return {pairs.view(), starts.view()}; }

    std::size_t bytes() const {
        return pairs.bytes() + starts.bytes() + counts.bytes() + remembered.bytes();
    }
    static std::size_t predictedBytes(std::size_t bodyCount, std::size_t capacity) {
        return capacity * sizeof(Pair) +
               (bodyCount * (2 + rememberedPartners) + 1) * sizeof(std::uint32_t);
    }

    DeviceBuffer<Pair> pairs;
    DeviceBuffer<std::uint32_t> starts;
    DeviceBuffer<std::uint32_t> counts;
    DeviceBuffer<std::uint32_t> remembered;
};

}  // namespace ballpit
