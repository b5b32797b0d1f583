// Chapter 09: whole recordings, decoded again. The decoder is the oracle.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <optional>

#include "09_video_recording/video_recorder.h"
#include "common/video_player.h"
#include "tests/checks/check_09_easel.cuh"
#include "tests/checks/check_09_queue.cuh"

namespace ballpit::check {

/// A file name that is gone at the end of the scope.
class TemporaryVideo {
public:
    TemporaryVideo() {
        static int number = 0;
        folder_ = std::filesystem::temp_directory_path() /
                  ("ballpit_check_09_" + std::to_string(getpid()) + "_" + text(number++));
        std::filesystem::create_directory(folder_);
    }
    ~TemporaryVideo() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    TemporaryVideo(const TemporaryVideo&) = delete;
    std::string path() const { return (folder_ / "clip.mp4").string(); }

private:
    std::filesystem::path folder_;
};

inline std::vector<Frame> numberedFrames(int count) {
    std::vector<Frame> frames;
    for (int k = 0; k < count; ++k) frames.push_back(numberedFrame(k));
    return frames;
}

/// More than an encoder holds back.
constexpr int clipFrames = 24;

enum class Source { drawn, memory };

/// Records numbered frames and plays them; nothing, and a failure, if there is no file to play.
inline std::optional<PlayedVideo> recorded(Report& report, int count, int rate, Source source) {
    if (somethingHangs()) {
        report.fail("not tried: two threads wait for each other for ever (see the checks before)");
        return {};
    }
    const TemporaryVideo file;
    Easel easel(testWidth, testHeight);
    try {
        VideoRecorder recorder(file.path(), testWidth, testHeight, rate);
        for (const Frame& frame : numberedFrames(count)) {
            if (source == Source::drawn) easel.show(frame);
            source == Source::drawn ? recorder.captureFrame() : recorder.captureFrame(frame);
        }
        recorder.release();
        return playVideo(file.path());
    } catch (const std::exception& error) {
        report.fail(text(count) + " frames were not recorded: " + error.what());
        return {};
    }
}

inline std::vector<int> numbersIn(const std::vector<Frame>& frames) {
    std::vector<int> numbers;
    for (const Frame& frame : frames) numbers.push_back(numberIn(frame));
    return numbers;
}

inline void drawSheets(Report& report, const std::vector<Frame>& got) {
    if (report.failed())
        report.picture([&] { return contactSheets(got, numberedFrames(clipFrames)); });
}

inline bool lacksLast(const std::vector<int>& got, int count) {
    return !got.empty() && got.size() < static_cast<std::size_t>(count) &&
           got == upTo(static_cast<int>(got.size()));
}

/// Each frame once, in order: by the bar codes.
inline void everyFrameInOrder(Report& report) {
    for (const int count : {clipFrames, 1, 2, 37}) {
        const auto video = recorded(report, count, 60, Source::drawn);
        if (!video) return;
        const std::vector<int> got = numbersIn(video->frames);
        if (got != upTo(count))
            report.fail("the frames' numbers, decoded again", text(got.size()) + ": " + listed(got),
                        text(count) + ": " + listed(upTo(count)));
        const auto shiftedBy = [&](int by) {
            return got.size() > 2 && got[1] == 1 - by && got[2] == 2 - by;
        };
        report.guess(
            {{"the last frame is missing: it was still under way when the recording ended",
              [&] { return lacksLast(got, count) && int(got.size()) == count - 1; }},
             {"the last frames are missing: the encoder still held them",
              [&] { return lacksLast(got, count) || (!got.empty() && got.back() < count - 3); }},
             {"the first frame comes twice: a buffer is fetched before its turn",
              [&] { return got.size() > 2 && got[0] == got[1]; }},
             {"the frames lag behind: the buffers' turns differ", [&] { return shiftedBy(1); }},
             {"a frame early: the buffer that was just started is fetched",
              [&] { return shiftedBy(-1); }},
             {"frames are dropped", [&] {
                  return got.size() < static_cast<std::size_t>(count) &&
                         std::is_sorted(got.begin(), got.end());
              }}});
        if (report.failed()) return drawSheets(report, video->frames);
    }
}

/// Count, size, rate and times as the file states them.
inline void exactRate(Report& report) {
    for (const int rate : {60, 25}) {
        const auto video = recorded(report, 20, rate, Source::drawn);
        if (!video) return;
        const std::string at = " at " + text(rate) + " frames a second";
        const auto compare = [&](const std::string& what, const std::string& got,
                                 const std::string& expected) {
            if (got != expected) report.fail(what + at, got, expected);
        };
        compare("size", text(video->width) + "x" + text(video->height),
                text(testWidth) + "x" + text(testHeight));
        compare("frames", text(video->frames.size()), "20");
        compare("rate", text(video->framesPerSecond) + "/" + text(video->perSeconds),
                text(rate) + "/1");
        compare("colours", video->colorSpace + ", " + video->colorRange, "bt709, tv");
        for (std::size_t k = 0; k < video->times.size(); ++k)
            if (std::abs(video->times[k] * rate - static_cast<double>(k)) > 0.01)
                report.fail("time of frame " + text(k) + at + ", in frames",
                            text(static_cast<float>(video->times[k] * rate)), text(k));
        report.guess({{"times not rescaled: the video is over in a moment",
                       [&] { return video->framesPerSecond / video->perSeconds > 10 * rate; }}});
        if (report.failed()) return;
    }
}

inline void guessPlaces(Report& report, const std::vector<Frame>& frames) {
    const Frame right = numberedFrame(0);
    const auto everyCorner = [&](auto expected) {
        return std::all_of(corners.begin(), corners.end(), [&](const Corner& corner) {
            return isNear(colorAt(frames[0], corner.x, corner.y), expected(corner), 40);
        });
    };
    report.guess({{"upside down: OpenGL's first row is the bottom one",
                   [&] {
                       return everyCorner([&](const Corner& c) {
                           return colorAt(right, c.x, testHeight - 1 - c.y);
                       });
                   }},
                  {"red and blue exchanged: BGR",
                   [&] {
                       return everyCorner([](const Corner& c) {
                           return Color{c.color.b, c.color.g, c.color.r};
                       });
                   }},
                  {"row padding: every row begins a little farther on than it should", [&] {
                       return !isNear(colorAt(frames[0], corners[3].x, corners[3].y), yellow, 40);
                   }}});
}

/// `places`: corners that must have their colour.
inline void patches(Report& report, int tolerance, Source source) {
    const auto video = recorded(report, clipFrames, 60, source);
    if (!video || video->frames.empty()) {
        if (video) report.fail("the video has no frames");
        return;
    }
    for (std::size_t k = 0; k < video->frames.size(); ++k)
        for (const Corner& corner : corners) {
            const Color got = colorAt(video->frames[k], corner.x, corner.y);
            if (!isNear(got, corner.color, tolerance))
                report.fail("frame " + text(k) + ", " + corner.name, text(got), text(corner.color));
        }
    if (!report.failed()) return;
    guessPlaces(report, video->frames);
    drawSheets(report, video->frames);
}

inline void upright(Report& report) { patches(report, 60, Source::drawn); }
inline void rightColors(Report& report) { patches(report, 10, Source::drawn); }
inline void fromMemory(Report& report) { patches(report, 10, Source::memory); }

}  // namespace ballpit::check
