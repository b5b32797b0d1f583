// Chapter 09: frames drawn by OpenGL pixel by pixel, and what a reader gets of them.
#pragma once

#include <GL/glew.h>

#include "09_video_recording/pixel_reader.h"
#include "tests/checks/check_09_frames.cuh"

namespace ballpit::check {

/// A framebuffer to show frames on. It stays bound as long as it lives.
class Easel {
public:
    Easel(int width, int height) : width_(width), height_(height) {
        glGenFramebuffers(1, &framebuffer_);
        glGenRenderbuffers(1, &pixels_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glBindRenderbuffer(GL_RENDERBUFFER, pixels_);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels_);
        glViewport(0, 0, width, height);
    }
    ~Easel() {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteRenderbuffers(1, &pixels_);
    }
    Easel(const Easel&) = delete;

    void show(const Frame& frame) {
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        // One row after the other: OpenGL counts rows from below.
        for (int row = 0; row < height_; ++row) {
            glWindowPos2i(0, height_ - 1 - row);
            glDrawPixels(width_, 1, GL_RGB, GL_UNSIGNED_BYTE,
                         frame.rgb.data() + 3 * static_cast<std::size_t>(row * width_));
        }
    }

private:
    int width_, height_;
    GLuint framebuffer_ = 0, pixels_ = 0;
};

/// What OpenGL has of a frame: the bottom row first, and opaque.
inline std::vector<std::uint8_t> asRead(const Frame& frame) {
    std::vector<std::uint8_t> bytes;
    for (int y = frame.height - 1; y >= 0; --y)
        for (int x = 0; x < frame.width; ++x) {
            const Color color = colorAt(frame, x, y);
            for (const int value : {color.r, color.g, color.b, 255})
                bytes.push_back(static_cast<std::uint8_t>(value));
        }
    return bytes;
}

/// No two neighbouring pixels alike; `number` makes frames differ.
inline Frame noise(int width, int height, int number) {
    Frame frame = blank(width, height, black);
    for (std::size_t k = 0; k < frame.rgb.size(); ++k)
        frame.rgb[k] = static_cast<std::uint8_t>((k * 37 + k / 7 * 11 + number * 83) % 251);
    return frame;
}

inline void releaseBindings() { glBindBuffer(GL_PIXEL_PACK_BUFFER, 0); }

inline bool requireUnbound(Report& report, const std::string& when) {
    GLint bound = 0;
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &bound);
    releaseBindings();
    if (bound) report.fail("the pixel buffer after " + when, "still bound", "unbound (0)");
    if (const GLenum error = glGetError())
        report.fail("OpenGL's error after " + when, text(error), "none (0)");
    return !report.failed();
}

inline void readPixelsExactly(Report& report) {
    for (const auto& [width, height] :
         {std::pair{2, 2}, {testWidth, testHeight}, {33, 7}, {64, 32}}) {
        Easel easel(width, height);
        PixelReader reader(width, height);
        const Frame frame = noise(width, height, 1);
        easel.show(frame);
        Pixels pixels;
        reader.start();
        reader.fetch(pixels);
        releaseBindings();
        const std::vector<std::uint8_t> expected = asRead(frame);
        const std::string size = " of a frame of " + text(width) + "x" + text(height);
        if (pixels.bytes.size() != expected.size())
            return report.fail("bytes" + size, text(pixels.bytes.size()), text(expected.size()));
        for (std::size_t k = 0; k < expected.size(); ++k)
            if (pixels.bytes[k] != expected[k])
                report.fail("byte " + text(k) + size, text(int{pixels.bytes[k]}),
                            text(int{expected[k]}));
        std::vector<std::uint8_t> tight = pixels.bytes;
        report.guess({{"nothing arrives: is the buffer mapped, and copied from?",
                       [&] {
                           return std::all_of(tight.begin(), tight.end(),
                                              [&](std::uint8_t b) { return b == tight[0]; });
                       }},
                      {"three bytes a pixel where four are expected", [&] {
                           return tight[0] == expected[0] && tight[3] == expected[4] &&
                                  tight[4] == expected[5];
                       }}});
        if (report.failed()) return;
    }
}

inline void leavesNothingBound(Report& report) {
    Easel easel(testWidth, testHeight);
    PixelReader reader(testWidth, testHeight);
    easel.show(noise(testWidth, testHeight, 0));
    Pixels pixels;
    reader.start();
    if (!requireUnbound(report, "start"))
        return report.guess(
            {{"whoever reads pixels next writes into this buffer", [] { return true; }}});
    reader.fetch(pixels);
    requireUnbound(report, "fetch");
    reader.start();  // into a buffer that is still mapped, OpenGL reads nothing
    reader.fetch(pixels);
    reader.start();
    requireUnbound(report, "the third start");
    reader.fetch(pixels);
    requireUnbound(report, "the third fetch");
}

/// Which of the frames shown so far this is; -1 for none.
inline int whichFrame(const Pixels& pixels, int width, int height, int shown) {
    for (int number = 0; number < shown; ++number)
        if (pixels.bytes == asRead(noise(width, height, number))) return number;
    return -1;
}

inline void twoUnderWay(Report& report) {
    constexpr int width = 20, height = 6, frames = 7;
    Easel easel(width, height);
    for (const PixelReader::Way way : {PixelReader::Way::pixelBuffers, PixelReader::Way::plain}) {
        PixelReader reader(width, height, way);
        Pixels pixels;
        std::vector<int> got;
        const auto fetch = [&](int shown) {
            reader.fetch(pixels);
            releaseBindings();
            got.push_back(whichFrame(pixels, width, height, shown));
        };
        for (int number = 0; number < frames; ++number) {
            easel.show(noise(width, height, number));
            reader.start();
            releaseBindings();
            if (number > 0) fetch(number + 1);
        }
        fetch(frames);
        for (int k = 0; k < frames; ++k)
            if (got[static_cast<std::size_t>(k)] != k)
                report.fail("fetch " + text(k),
                            got[static_cast<std::size_t>(k)] < 0
                                ? "no frame that was drawn"
                                : "frame " + text(got[static_cast<std::size_t>(k)]),
                            "frame " + text(k));
        report.guess(
            {{"the buffer that was just started is fetched: not the oldest",
              [&] { return got[0] == 1 && got[frames - 1] == frames - 2; }},
             {"one buffer for both: a frame is overwritten by the next before it was fetched",
              [&] { return got[0] == 1 && got[1] == 2; }},
             {"the buffers' turns differ: started in one, fetched from the other",
              [&] { return got[1] == 0 || got[0] == -1; }}});
    }
}

}  // namespace ballpit::check
