// A picture on its way from the framebuffer to the encoder, and memory that is used again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace ballpit {

/// width * height pixels, row by row without gaps, as they were read.
struct Pixels {
    int width = 0, height = 0;
    int channels = 4;      ///< bytes a pixel: 4 (red, green, blue, alpha) or 3 (without alpha)
    bool bottomUp = true;  ///< the first row in memory is the bottom one, as OpenGL has it
    std::vector<std::uint8_t> bytes;

    /// Takes this size; the bytes are whatever they were.
    void resize(int newWidth, int newHeight, int newChannels) {
        width = newWidth, height = newHeight, channels = newChannels;
        bytes.resize(static_cast<std::size_t>(channels) * static_cast<std::size_t>(width) *
                     static_cast<std::size_t>(height));
    }
};

/// Pictures that have been encoded: their memory is for the next ones. A new picture of 1920x1080
/// costs 2000 page faults, a used one none.
class UsedPixels {
public:
    Pixels take() {
        const std::lock_guard lock(mutex_);
        if (pictures_.empty()) return {};
        Pixels picture = std::move(pictures_.back());
        pictures_.pop_back();
        return picture;
    }
    void giveBack(Pixels picture) {
        if (picture.bytes.empty()) return;
        const std::lock_guard lock(mutex_);
        pictures_.push_back(std::move(picture));
    }

private:
    std::mutex mutex_;
    std::vector<Pixels> pictures_;
};

}  // namespace ballpit
