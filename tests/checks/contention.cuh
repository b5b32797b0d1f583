// Finds counts that are not atomic. Threads that count at the same time lose some, but only while
// they really run at the same time, which a busy machine may not let them for a while. So each
// launch also feeds a bait: a counter of our own that is not atomic. Once it has lost enough, a
// counter of the student's that is wrong in the same way has lost some, too.
#pragma once

#include <atomic>

#include "common/timing.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

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

/// Launches `body` for `count` indices again and again, until threads got in each other's way.
/// Gives up after two seconds: with one core they never do. Returns the number of launches.
template <auto body, class... Args>
int launchUntilContended(Device device, int count, Args... args) {
    constexpr std::int64_t enoughLost = 2000;
    constexpr double longest = 2000;  // ms
    const Threads threads(LaunchOrder::forward, 2);
    DeviceBuffer<std::uint32_t> bait(device, 1, "bait");
    bait.fill(0);
    const double start = milliseconds();
    for (int launches = 1;; ++launches) {
        launch<withBait<body, Args...>>(device, count, bait.view(), args...);
        const std::int64_t lost = std::int64_t{launches} * count - bait.download()[0];
        if (lost >= enoughLost || milliseconds() - start > longest) return launches;
    }
}

}  // namespace ballpit::check
