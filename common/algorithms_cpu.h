// The CPU's sort, scan and reduce: arguments as in algorithms.h.
#pragma once

#include <cstdint>

namespace ballpit::cpu {

void sortPairs(int count, int keyBits, std::uint32_t* keys, std::uint32_t* values,
               std::uint32_t* sortedKeys, std::uint32_t* sortedValues);
void exclusiveScan(int count, const std::uint32_t* counts, std::uint32_t* starts);
float reduceMaximum(int count, const float* values);

}  // namespace ballpit::cpu
