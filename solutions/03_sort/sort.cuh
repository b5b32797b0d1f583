// Chapter 03: sorting (hash, slot) pairs by hash, stably, digit by digit from the lowest.
//
// `radixSort` is the sort a student writes: every thread owns a tile of consecutive elements. The
// engine itself calls the library (`sortByHash`); the chapter races the two.
#pragma once

#include <algorithm>

#include "common/algorithms.h"
#include "common/buffer.cuh"
#include "common/launch.cuh"
#include "common/uniform_grid.cuh"

namespace ballpit {

constexpr int digitBits = 4;
constexpr std::uint32_t digitCount = 1u << digitBits;
constexpr int tileSize = 256;

HD inline std::uint32_t digitOf(std::uint32_t key, int shift) {
    return key >> shift & (digitCount - 1u);
}

HD inline int tileEnd(int tile, int count) {
    const int end = (tile + 1) * tileSize;
    return end < count ? end : count;
}

/// How many keys of this tile have each digit? Written digit by digit over all tiles, so that one
/// scan of `counts` gives every tile's first place for every digit.
HD inline void countDigits(int tile, int count, int tileCount, int shift,
                           View<const std::uint32_t> keys, View<std::uint32_t> counts) {
    std::uint32_t histogram[digitCount] = {};
    for (int i = tile * tileSize; i < tileEnd(tile, count); ++i)
        ++histogram[digitOf(keys[i], shift)];
    for (std::uint32_t digit = 0; digit < digitCount; ++digit)
        counts[digit * static_cast<std::uint32_t>(tileCount) + static_cast<std::uint32_t>(tile)] =
            histogram[digit];
}

/// The arrays of one pass: `from` is read, `to` is written.
struct SortPassView {
    View<const std::uint32_t> fromKeys, fromValues;
    View<std::uint32_t> toKeys, toValues;
};

/// Moves the elements of this tile to their places, first to last, which keeps the sort stable.
HD inline void scatterByDigit(int tile, int count, int tileCount, int shift, SortPassView pass,
                              View<const std::uint32_t> starts) {
    std::uint32_t next[digitCount];
    for (std::uint32_t digit = 0; digit < digitCount; ++digit)
        next[digit] = starts[digit * static_cast<std::uint32_t>(tileCount) +
                             static_cast<std::uint32_t>(tile)];
    for (int i = tile * tileSize; i < tileEnd(tile, count); ++i) {
        const std::uint32_t place = next[digitOf(pass.fromKeys[i], shift)]++;
        pass.toKeys[place] = pass.fromKeys[i];
        pass.toValues[place] = pass.fromValues[i];
    }
}

/// Sorts (keys, values) by the lowest `keyBits` bits of the key, stably, in place.
inline void radixSort(Device device, int keyBits, DeviceBuffer<std::uint32_t>& keys,
                      DeviceBuffer<std::uint32_t>& values, Scratch& scratch) {
    const int count = static_cast<int>(keys.count());
    const int tileCount = (count + tileSize - 1) / tileSize;
    const std::size_t countersNeeded = static_cast<std::size_t>(tileCount) * digitCount;
    DeviceBuffer<std::uint32_t> counts(device, countersNeeded, "digitCounts");
    DeviceBuffer<std::uint32_t> starts(device, countersNeeded + 1, "digitStarts");
    DeviceBuffer<std::uint32_t> otherKeys(device, keys.count(), "otherKeys");
    DeviceBuffer<std::uint32_t> otherValues(device, values.count(), "otherValues");

    for (int shift = 0; shift < keyBits; shift += digitBits) {
        launch<countDigits>(device, tileCount, count, tileCount, shift,
                            View<const std::uint32_t>(keys.view()), counts.view());
        exclusiveScan(device, static_cast<int>(countersNeeded), counts.data(), starts.data(),
                      scratch);
        const SortPassView pass{keys.view(), values.view(), otherKeys.view(), otherValues.view()};
        launch<scatterByDigit>(device, tileCount, count, tileCount, shift, pass,
                               View<const std::uint32_t>(starts.view()));
        std::swap(keys, otherKeys);
        std::swap(values, otherValues);
    }
}

/// Sorts the grid's (hash, slot) pairs with the library, over only as many bits as the cells need.
inline void sortByHash(Device device, int count, UniformGrid& grid, Scratch& scratch) {
    sortPairs(device, count, grid.hashBits(), grid.hashes.data(), grid.indices.data(),
              grid.sortedHashes.data(), grid.sortedIndices.data(), scratch);
}

}  // namespace ballpit
