// Many threads append to one list at once: are pairs lost? And were the threads at work at once?
#pragma once

#include "01_naive_collision/naive_collision.cuh"

#include <algorithm>

#include "common/timing.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

constexpr int crowd = 4096, appendsEach = 50, appends = crowd * appendsEach;

/// Each thread appends many pairs, and beside each adds one as it must not be done: it reads, adds
/// and writes back. That counter is the control: where it has lost nothing, the threads were not
/// at work at once, and that nothing else was lost proves nothing.
HD inline void appendMany(int thread, View<Pair> pairs, View<std::uint32_t> found,
                          View<std::uint32_t> control) {
    volatile std::uint32_t& careless = control[0];
    for (int k = 0; k < appendsEach; ++k) {
        appendPair(pairOf(k, thread), pairs, found);
        careless = careless + 1;
    }
}

struct Rush {
    std::uint32_t counted, stored;  ///< pairs; stored: different ones
    bool wasCrowded;                ///< threads were at work at once
};

inline Rush rush(Device device, int threads) {
    const Threads scope(LaunchOrder::forward, threads);
    DeviceBuffer<Pair> pairs(device, appends, "pairs");
    auto found = uploaded(device, std::vector<std::uint32_t>{0}, "found");
    auto control = uploaded(device, std::vector<std::uint32_t>{0}, "control");
    launch<appendMany>(device, crowd, pairs.view(), found.view(), control.view());
    std::vector<bool> seen(appends);
    for (const Pair p : pairs.download())
        if (p.first < appendsEach && p.second < crowd) seen[p.first * crowd + p.second] = true;
    return {found.download()[0],
            static_cast<std::uint32_t>(std::count(seen.begin(), seen.end(), true)),
            control.download()[0] != appends};
}

/// Many threads append at the same time, and do nothing else.
inline void appendInACrowd(Report& report) {
    const auto fails = [](const Rush& r) { return r.counted != appends || r.stored != appends; };
    const auto inWords = [](const Rush& r) {
        return text(r.counted) + " counted, " + text(r.stored) + " stored";
    };
    if (report.device == Device::cpu) {
        const Rush alone = rush(Device::cpu, 1);
        if (fails(alone))
            return report.fail("pairs appended by one thread", inWords(alone), text(appends));
    }
    if (report.device == Device::cpu && cpuThreadCount() == 1) return;  // no crowd to be had
    // Another program may hold the second core, so try until five rounds were crowded.
    const double end = milliseconds() + 15000;
    for (int crowded = 0; crowded < 5 && milliseconds() < end;) {
        const Rush together = rush(report.device, 2);
        if (fails(together))
            return report.racy(text(appends) + " pairs appended by many threads at once, " +
                               inWords(together));
        crowded += together.wasCrowded;
    }
}

}  // namespace ballpit::check
