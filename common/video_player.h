// A video as a player sees it: what was recorded, decoded again.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/frame.h"

namespace ballpit {

/// What a file says of itself, in FFmpeg's words ("h264", "yuv420p", "bt709", "tv").
struct Video {
    std::string codec, pixelFormat, colorSpace, colorRange;
    int width = 0, height = 0;
    int framesPerSecond = 0, perSeconds = 1;  ///< the rate as a fraction: 60/1
    std::vector<double> times;                ///< of each frame that was decoded, in s
};

/// Decodes all frames and gives each to `visit`, in the order in which they are shown; of those
/// whose number is not `wanted` only the time is noted, which is faster. Throws std::runtime_error
/// if no player could open the file. A file that ends too early plays up to there.
Video watchVideo(
    const std::string& path, const std::function<void(const Frame&)>& visit,
    const std::function<bool(std::size_t)>& wanted = [](std::size_t) { return true; });

/// Keeps the frames.
struct PlayedVideo : Video {
    std::vector<Frame> frames;
};
PlayedVideo playVideo(const std::string& path);

}  // namespace ballpit
