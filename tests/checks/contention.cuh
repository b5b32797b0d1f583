// Finds counts that are not atomic. Threads that count at the same time lose some, but only while
// they really run at the same time, which a busy machine may not let them for a while. So each
// launch also feeds a bait: a counter of our own that is not atomic. Once it has lost some in
// enough launches, a counter of the student's that is wrong in the same way has lost some, too.
//
// Launches are counted, and not what they lose: on a busy machine a thread that is interrupted
// between reading and writing undoes all that others count meanwhile, though no two ever ran at the
// same time. But that happens in one launch of a hundred at most.
#pragma once

#include <atomic>

#include "common/timing.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

/// That this program may use; 1 without OpenMP.
inline int processorCount() {
#ifdef _OPENMP
    return omp_get_num_procs();
#else
    return 1;
#endif
}

/// Reads and writes in two steps: what another thread adds in between is lost.
HD inline void takeBait(std::uint32_t& bait) {
#ifdef __CUDA_ARCH__
    volatile std::uint32_t& counter = bait;
    counter = counter + 1;
#else
    std::atomic_ref<std::uint32_t> counter(bait);
    counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
#endif
}

template <auto body, class... Args>
HD void withBait(int i, View<std::uint32_t> bait, Args... args) {
    body(i, args...);
    takeBait(bait[0]);
}

/// How often a kernel was launched, and whether threads got in each other's way meanwhile.
struct Contention {
    int launches;
    bool happened;
};

/// Launches `body` for `count` indices again and again until threads get in each other's way. On a
/// busy machine that may take seconds; with one core it never happens.
template <auto body, class... Args>
Contention launchUntilContended(Device device, int count, Args... args) {
    constexpr int enoughLossy = 20, atLeastOneIn = 10;
    const double longest = device == Device::cuda || processorCount() > 1 ? 15000 : 0;  // ms
    const Threads threads(LaunchOrder::forward, 2);
    DeviceBuffer<std::uint32_t> bait(device, 1, "bait");
    bait.fill(0);
    const double start = milliseconds();
    std::uint32_t before = 0;
    for (int launches = 1, lossy = 0;; ++launches) {
        launch<withBait<body, Args...>>(device, count, bait.view(), args...);
        const std::uint32_t now = bait.download()[0];
        lossy += now - before < static_cast<std::uint32_t>(count);
        before = now;
        if (lossy >= enoughLossy && atLeastOneIn * lossy >= launches) return {launches, true};
        if (milliseconds() - start > longest) return {launches, false};
    }
}

}  // namespace ballpit::check
