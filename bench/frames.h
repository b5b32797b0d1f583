// How many frames a second can be stepped and drawn: `./ballpit bench --frames`.
#pragma once

#include <string>
#include <vector>

#include "common/device.h"

namespace ballpit {

struct FramesPlan {
    Device device = Device::cpu;
    std::vector<int> counts;  ///< balls; empty: as many as suit the device
    int repeats = 60;         ///< frames; the median is shown
    std::string csv;          ///< file to write the table to as well; empty: none
};

/// Steps and draws gravity_fall offscreen at 1920x1080 and prints the medians of both times, with
/// the positions handed over as they would be in a recording, and through main memory. In a build
/// without graphics: InputError.
void runFramesBench(const FramesPlan& plan);

}  // namespace ballpit
