// From the framebuffer to main memory without waiting: two pixel buffers take turns.
#pragma once

#include <GL/glew.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "09_video_recording/pixels.h"
#include "common/hole.cuh"

namespace ballpit {

/// Reads frames of one size from the framebuffer that is bound for reading. A frame is under way
/// from start() to fetch(), at most two at a time, and they arrive in the order in which they were
/// started. Needs the OpenGL context that is current, as long as the reader lives.
class PixelReader {
public:
    /// Through pixel buffers; or plainly, where the driver has none: then start() waits.
    enum class Way { pixelBuffers, plain };

    static Way bestWay() {
        const bool haveBuffers = GLEW_VERSION_2_1 || GLEW_ARB_pixel_buffer_object;
        return haveBuffers ? Way::pixelBuffers : Way::plain;
    }

    PixelReader(int width, int height, Way way = bestWay())
        : width_(width), height_(height), way_(way) {
        for (Pixels& pixels : plain_)
            if (way == Way::plain) pixels.resize(width, height, 4);
        if (way == Way::pixelBuffers) makeBuffers();
    }
    ~PixelReader() {
        if (way_ == Way::pixelBuffers) glDeleteBuffers(2, buffers_.data());
    }
    PixelReader(const PixelReader&) = delete;

    /// Begins to read what has been drawn. With pixel buffers it returns at once: the driver copies
    /// the frame when the drawing is done, and meanwhile the next frame can be drawn.
    void start() {
        way_ == Way::plain ? startPlain() : startBuffer();
        ++started_;
    }

    /// The frame that was started first and is still under way, as OpenGL has it: 4 bytes a pixel,
    /// the bottom row first. Waits for it if it must.
    void fetch(Pixels& pixels) {
        pixels.resize(width_, height_, 4);
        pixels.bottomUp = true;
        way_ == Way::plain ? std::swap(pixels.bytes, plain_[fetched_ % 2].bytes)
                           : fetchBuffer(pixels);
        ++fetched_;
    }

    int underWay() const { return static_cast<int>(started_ - fetched_); }

private:
    void makeBuffers() {
        Pixels size;
        size.resize(width_, height_, 4);
        glGenBuffers(2, buffers_.data());
        for (const GLuint buffer : buffers_) {
            glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
            glBufferData(GL_PIXEL_PACK_BUFFER, static_cast<GLsizeiptr>(size.bytes.size()), nullptr,
                         GL_STREAM_READ);
        }
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    }

    /// Four bytes a pixel are a plain copy in every driver; three are slow.
    void startPlain() {
        glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE,
                     plain_[started_ % 2].bytes.data());
    }

    /// Frame 0 goes to buffer 0, frame 1 to buffer 1, frame 2 to buffer 0 again. While a buffer is
    /// bound, glReadPixels writes into it, and its pointer counts from the buffer's first byte.
    void startBuffer() {
        // ---- hole read.start (about 3 lines): Bind the buffer whose turn it is, read into it, unbind it
        TODO_HOLE("read.start");
        // ---- end of read.start
    }

    void fetchBuffer(Pixels& pixels) {
        // ---- hole read.fetch (about 4 lines): Bind and map the buffer of the oldest frame, copy, unmap, unbind
        TODO_HOLE("read.fetch");
        // ---- end of read.fetch
    }

    static void copyMapped(const void* mapped, Pixels& pixels) {
        if (!mapped) throw std::runtime_error("OpenGL could not hand out a pixel buffer");
        std::memcpy(pixels.bytes.data(), mapped, pixels.bytes.size());
    }

    int width_, height_;
    Way way_;
    unsigned started_ = 0, fetched_ = 0;  // frames, since the reader was made
    std::array<GLuint, 2> buffers_{};
    std::array<Pixels, 2> plain_;
};

}  // namespace ballpit
