// Sort, scan and reduce: the three library algorithms of the engine. CUB on a GPU (one file of the
// project compiles it: it costs ten seconds wherever it is included), OpenMP loops on a CPU.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/buffer.cuh"

namespace ballpit {

/// Working memory of the algorithms; grows to the largest call it served.
using Scratch = DeviceBuffer<std::byte>;

/// Sorts (key, value) pairs by the lowest `keyBits` bits of the key, stably: equal keys keep their
/// order. All four arrays have `count` elements; the inputs are destroyed.
void sortPairs(Device device, int count, int keyBits, std::uint32_t* keys, std::uint32_t* values,
               std::uint32_t* sortedKeys, std::uint32_t* sortedValues, Scratch& scratch);

/// starts[i] = counts[0] + ... + counts[i-1]; `starts` has count + 1 elements, the last one the
/// total.
void exclusiveScan(Device device, int count, const std::uint32_t* counts, std::uint32_t* starts,
                   Scratch& scratch);

/// The largest of `count` values, 0 if there is none. Waits for the device.
float reduceMaximum(Device device, int count, const float* values, Scratch& scratch);

}  // namespace ballpit
