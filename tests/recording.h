// Frames that tell what has become of them, a folder to record into, and how a recording is
// checked.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "09_video_recording/video_recorder.h"
#include "common/error.h"
#include "common/video_player.h"
#include "tests/catch.h"

namespace ballpit {

namespace fs = std::filesystem;

constexpr int testWidth = 320, testHeight = 180, testRate = 60, testCount = 30;

using Color = std::array<int, 3>;
constexpr Color topLeft{220, 60, 30}, bottomRight{40, 80, 210};

inline void setPixel(Frame& frame, int column, int row, Color color) {
    for (std::size_t k = 0; k < 3; ++k)
        frame.rgb[3 * static_cast<std::size_t>(row * frame.width + column) + k] =
            static_cast<std::uint8_t>(color[k]);
}

/// Left and bottom, top and right differ, and the bar in the middle grows with the number.
inline Frame testFrame(int number) {
    Frame frame{testWidth, testHeight,
                std::vector<std::uint8_t>(std::size_t{3} * testWidth * testHeight, 128)};
    for (int row = 0; row < testHeight; ++row)
        for (int column = 0; column < testWidth; ++column) {
            if (row < testHeight / 3 && column < testWidth / 2)
                setPixel(frame, column, row, topLeft);
            else if (row >= 2 * testHeight / 3 && column >= testWidth / 2)
                setPixel(frame, column, row, bottomRight);
            else if (row >= testHeight / 3 && row < 2 * testHeight / 3 && column < 8 * (number + 1))
                setPixel(frame, column, row, {250, 250, 250});
        }
    return frame;
}

inline Color colorAt(const Frame& frame, int column, int row) {
    const std::size_t at = 3 * static_cast<std::size_t>(row * frame.width + column);
    return {frame.rgb[at], frame.rgb[at + 1], frame.rgb[at + 2]};
}

/// In pixels.
inline int barLength(const Frame& frame) {
    int length = 0;
    while (length < frame.width && colorAt(frame, length, frame.height / 2)[1] > 190) ++length;
    return length;
}

inline bool isNear(Color a, Color b, int tolerance) {
    for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(a[i] - b[i]) > tolerance) return false;
    return true;
}

/// As many as there are: in order, upright, in the right colours, at the right times.
inline void checkFrames(const PlayedVideo& video) {
    for (std::size_t k = 0; k < video.frames.size(); ++k) {
        const Frame& frame = video.frames[k];
        const Color first = colorAt(frame, 4, 4);
        const Color last = colorAt(frame, frame.width - 5, frame.height - 5);
        CAPTURE(k, first, last);
        // Matroska counts in milliseconds.
        const double rate = double(video.framesPerSecond) / video.perSeconds;
        CHECK(video.times[k] * rate == Approx(double(k)).margin(0.1));
        CHECK(barLength(frame) == Approx(8.0 * double(k + 1)).margin(2));
        CHECK(isNear(first, topLeft, 12));
        CHECK(isNear(last, bottomRight, 12));
    }
}

/// And none is missing.
inline void checkFrames(const PlayedVideo& video, int count) {
    REQUIRE(video.frames.size() == static_cast<std::size_t>(count));
    checkFrames(video);
}

inline void captureAll(VideoRecorder& recorder, int count = testCount) {
    for (int i = 0; i < count; ++i) recorder.captureFrame(testFrame(i));
}

using Names = std::vector<std::string>;

struct TemporaryFolder {
    fs::path path = fs::temp_directory_path() / ("ballpit-video-" + std::to_string(getpid()));
    TemporaryFolder() { fs::create_directory(path); }
    ~TemporaryFolder() { fs::remove_all(path); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    std::string operator/(const char* name) const { return (path / name).string(); }

    /// The names in it, so that a failure shows what was left behind.
    Names names() const {
        Names found;
        for (const auto& entry : fs::directory_iterator(path))
            found.push_back(entry.path().filename().string());
        std::ranges::sort(found);
        return found;
    }
};

inline bool mentions(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos && text.find('\n') == std::string::npos;
}

/// The message of the InputError that this throws; empty if it throws none.
template <class Work>
std::string refusalOf(Work work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

}  // namespace ballpit
