// One picture in main memory: what the renderer hands to the recorder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ballpit {

/// width * height pixels of 3 bytes (red, green, blue), row by row; row 0 is the top row.
struct Frame {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Writes a PNG file. The picture appears under its name only when it is complete. Throws
/// InputError if the path cannot be written, and std::invalid_argument if the frame's sizes
/// contradict each other.
void writePng(const std::string& path, const Frame& frame);

}  // namespace ballpit
