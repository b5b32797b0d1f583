// Chapter 03: sorting (hash, slot) pairs by hash, stably, digit by digit from the lowest.
//
// `radixSort` is the sort a student writes: every thread owns a tile of consecutive pairs. The
// engine itself calls the library (`sortByHash`); the chapter races the two.
#pragma once

#include <utility>

#include "common/algorithms.h"
#include "common/buffer.cuh"
#include "common/hole.cuh"
#include "common/launch.cuh"
#include "common/uniform_grid.cuh"

namespace ballpit {

constexpr int digitBits = 4;
constexpr std::uint32_t digitCount = 1u << digitBits;
constexpr int tileSize = 256;

/// The digit, 0 to 15, that begins at bit `shift`: one figure of the key written in hexadecimal.
HD inline std::uint32_t digitOf(std::uint32_t key, int shift) {
    // ---- hole sort.digit (about 1 line): The four bits of the key that begin at bit `shift`, as a number
    TODO_HOLE("sort.digit");
    return 0;
    // ---- end of sort.digit
}

/// `count` pairs are cut into tiles of tileSize; the last tile may be shorter.
HD inline int tileCountFor(int count) { return (count + tileSize - 1) / tileSize; }
HD inline int tileEnd(int tile, int count) {
    const int end = (tile + 1) * tileSize;
    return end < count ? end : count;
}

/// Which counter belongs to this digit in this tile? The scan adds the counters up in their order,
/// so it must be the order of the sorted list: digit 0 of every tile, then digit 1 of every tile.
HD inline std::uint32_t counterOf(std::uint32_t digit, int tile, int tileCount) {
    // ---- hole sort.layout (about 1 line): The counter's number: digit by digit, and in a digit tile by tile
    TODO_HOLE("sort.layout");
    return 0;
    // ---- end of sort.layout
}

/// How many keys of this tile have each digit?
HD inline void countDigits(int tile, int count, int shift, View<const std::uint32_t> keys,
                           View<std::uint32_t> counts) {
    std::uint32_t histogram[digitCount] = {};
    // ---- hole sort.count (about 2 lines): Count the digits of this tile's keys in `histogram`
    TODO_HOLE("sort.count");
    // ---- end of sort.count
    for (std::uint32_t digit = 0; digit < digitCount; ++digit)
        counts[counterOf(digit, tile, tileCountFor(count))] = histogram[digit];
}

/// The arrays of one pass: `from` is read, `to` is written.
struct SortPassView {
    View<const std::uint32_t> fromKeys, fromValues;
    View<std::uint32_t> toKeys, toValues;
};

/// Moves the pairs of this tile to their places. `starts` says where the tile's first pair of each
/// digit goes; the next pair of that digit goes behind it.
HD inline void scatterByDigit(int tile, int count, int shift, SortPassView pass,
                              View<const std::uint32_t> starts) {
    std::uint32_t next[digitCount];
    for (std::uint32_t digit = 0; digit < digitCount; ++digit)
        next[digit] = starts[counterOf(digit, tile, tileCountFor(count))];
    // ---- hole sort.scatter (about 5 lines): Move each pair of this tile, first to last, to its digit's next place
    TODO_HOLE("sort.scatter");
    // ---- end of sort.scatter
}

/// What a sort of `count` pairs needs besides them. Made once and used for every sort of so many:
/// a device takes its time to find memory.
struct RadixSortSpace {
    RadixSortSpace(Device device, int count)
        : keys(device, static_cast<std::size_t>(count), "otherKeys"),
          values(device, static_cast<std::size_t>(count), "otherValues"),
          counts(device, tileCountFor(count) * digitCount, "digitCounts"),
          starts(device, tileCountFor(count) * digitCount + 1, "digitStarts"),
          scratch(device, 0, "scratch") {}

    DeviceBuffer<std::uint32_t> keys, values;    ///< where a pass writes to
    DeviceBuffer<std::uint32_t> counts, starts;  ///< one of each digit in each tile
    Scratch scratch;
};

/// One pass: the pairs of (keys, values), ordered by one digit, are written to the space's arrays.
inline void sortPass(Device device, int shift, DeviceBuffer<std::uint32_t>& keys,
                     DeviceBuffer<std::uint32_t>& values, RadixSortSpace& space) {
    const int count = static_cast<int>(keys.count()), tileCount = tileCountFor(count);
    launch<countDigits>(device, tileCount, count, shift, View<const std::uint32_t>(keys.view()),
                        space.counts.view());
    exclusiveScan(device, static_cast<int>(space.counts.count()), space.counts.data(),
                  space.starts.data(), space.scratch);
    const SortPassView pass{keys.view(), values.view(), space.keys.view(), space.values.view()};
    launch<scatterByDigit>(device, tileCount, count, shift, pass,
                           View<const std::uint32_t>(space.starts.view()));
}

/// Sorts (keys, values) by key, stably, in place. Keys have no bits set above the lowest `keyBits`.
inline void radixSort(Device device, int keyBits, DeviceBuffer<std::uint32_t>& keys,
                      DeviceBuffer<std::uint32_t>& values, RadixSortSpace& space) {
    // ---- hole sort.passes (about 5 lines): A pass for every digit, lowest first; after each, swap the arrays
    TODO_HOLE("sort.passes");
    // ---- end of sort.passes
}

/// Sorts the grid's (hash, slot) pairs with the library, over only as many bits as the cells need.
inline void sortByHash(Device device, int count, UniformGrid& grid, Scratch& scratch) {
    // ---- hole sort.library (about 2 lines): Call sortPairs: from hashes and indices to their sorted arrays
    TODO_HOLE("sort.library");
    // ---- end of sort.library
}

}  // namespace ballpit
