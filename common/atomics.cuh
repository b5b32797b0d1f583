// Integer atomics on both machines. Only integers: their result does not depend on the order, so
// they keep the exactness contract; a float sum would not.
#pragma once

#include <cstdint>

#include "common/hd.h"

namespace ballpit {

/// Adds and returns the value before.
HD inline std::uint32_t fetchAdd(std::uint32_t& target, std::uint32_t value) {
#ifdef __CUDA_ARCH__
    return atomicAdd(&target, value);
#else
    return __atomic_fetch_add(&target, value, __ATOMIC_RELAXED);
#endif
}

/// Adds to two counters at once, packed in 64 bits.
HD inline void add(unsigned long long& target, unsigned long long value) {
#ifdef __CUDA_ARCH__
    atomicAdd(&target, value);
#else
    __atomic_fetch_add(&target, value, __ATOMIC_RELAXED);
#endif
}

/// Stores value and returns the value before.
HD inline std::uint32_t exchange(std::uint32_t& target, std::uint32_t value) {
#ifdef __CUDA_ARCH__
    return atomicExch(&target, value);
#else
    return __atomic_exchange_n(&target, value, __ATOMIC_RELAXED);
#endif
}

/// Lowers target to value if value is smaller.
HD inline void lowerTo(std::uint32_t& target, std::uint32_t value) {
#ifdef __CUDA_ARCH__
    atomicMin(&target, value);
#else
    std::uint32_t seen = __atomic_load_n(&target, __ATOMIC_RELAXED);
    while (value < seen && !__atomic_compare_exchange_n(&target, &seen, value, true,
                                                        __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
#endif
}

}  // namespace ballpit
