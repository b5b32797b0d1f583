// Wall-clock times of something that is run again and again.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "common/device.h"

namespace ballpit {

inline double milliseconds() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(now).count();
}

inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// The median time of `work` in ms, waiting for the device after each run; one run before the
/// first is not counted.
template <class Work>
double medianMilliseconds(Device device, int repeats, Work work) {
    work();
    synchronize(device);
    std::vector<double> times;
    for (int k = 0; k < repeats; ++k) {
        const double start = milliseconds();
        work();
        synchronize(device);
        times.push_back(milliseconds() - start);
    }
    return median(times);
}

}  // namespace ballpit
