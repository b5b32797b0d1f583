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
/// first is not counted. `prepare` runs before each, outside its time: work that eats its input.
template <class Prepare, class Work>
double medianMilliseconds(Device device, int repeats, Prepare prepare, Work work) {
    std::vector<double> times;
    for (int k = -1; k < repeats; ++k) {
        prepare();
        synchronize(device);
        const double start = milliseconds();
        work();
        synchronize(device);
        if (k >= 0) times.push_back(milliseconds() - start);
    }
    return median(times);
}

template <class Work>
double medianMilliseconds(Device device, int repeats, Work work) {
    const auto nothing = [] {};
    return medianMilliseconds(device, repeats, nothing, work);
}

}  // namespace ballpit
