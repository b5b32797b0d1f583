// A video on one page: frames from its whole length, small, in rows.
#pragma once

#include <algorithm>
#include <string>

#include "common/video_player.h"

namespace ballpit {

constexpr int sheetColumns = 4, sheetRows = 3;

/// The mean colour of `factor` by `factor` pixels for each pixel of the sheet.
inline void placeSmaller(Frame& sheet, const Frame& frame, int factor, int left, int top) {
    for (int y = 0; y < frame.height / factor; ++y)
        for (int x = 0; x < frame.width / factor; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                int sum = 0;
                for (int k = 0; k < factor * factor; ++k)
                    sum += frame.rgb[static_cast<std::size_t>(
                        3 * ((y * factor + k / factor) * frame.width + x * factor + k % factor) +
                        channel)];
                sheet.rgb[static_cast<std::size_t>(3 * ((top + y) * sheet.width + left + x) +
                                                   channel)] =
                    static_cast<std::uint8_t>(sum / (factor * factor));
            }
}

/// Plays a video of so many frames; what it says of itself, and the sheet in `sheet`.
inline Video playOntoSheet(const std::string& path, int frames, Frame& sheet) {
    constexpr int gap = 6, places = sheetColumns * sheetRows;
    int number = 0, factor = 1;
    return watchVideo(path, [&](const Frame& frame) {
        if (number == 0) {
            factor = std::max(1, frame.width / 320);
            const int width = sheetColumns * (frame.width / factor + gap) + gap;
            const int height = sheetRows * (frame.height / factor + gap) + gap;
            sheet = {width, height,
                     std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * height, 255)};
        }
        // The first frame is in the first place, the last in the last.
        for (int place = 0; place < places; ++place)
            if (number == place * (frames - 1) / (places - 1))
                placeSmaller(sheet, frame, factor,
                             gap + place % sheetColumns * (frame.width / factor + gap),
                             gap + place / sheetColumns * (frame.height / factor + gap));
        ++number;
    });
}

}  // namespace ballpit
