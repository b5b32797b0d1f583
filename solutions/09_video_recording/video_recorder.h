// Turns frames into a video file: H.264 in MP4 wherever that is possible.
#pragma once

#include "common/frame.h"

#include <memory>
#include <string>
#include <vector>

namespace ballpit {

/// Software encoders this machine may have, best first: those for H.264, then mpeg4.
std::vector<std::string> preferredEncoders();

/// Records frames of one size at one constant rate. While it records, the file is named
/// NAME.part.mp4 for a target NAME.mp4; release() completes it and gives it its name. So a file
/// with the final name is never half-written.
class VideoRecorder {
public:
    /// `path` ends in .mp4, .mkv, .mov or .avi; width and height are even. The first of `encoders`
    /// that works here is used. Throws InputError, leaving no file behind, if any of this cannot
    /// be.
    VideoRecorder(std::string path, int width, int height, int framesPerSecond,
                  const std::vector<std::string>& encoders = preferredEncoders());

    /// Without release(), after an exception: completes NAME.part.mp4, so that what was recorded
    /// can be played, but does not rename it. Never throws.
    ~VideoRecorder();

    /// Appends a frame. Throws std::invalid_argument if its size is not the recorder's, and
    /// std::runtime_error in the library's words if it cannot be encoded or written.
    void captureFrame(const Frame& frame);

    /// Completes the file and gives it its name; further calls do nothing. Throws InputError if no
    /// frame was captured (no player opens such a file) and std::runtime_error if writing fails.
    void release();

    std::string encoderName() const;
    /// Tells that a lesser encoder had to stand in for libx264, and the cure; empty otherwise.
    std::string notice() const;
    int frameCount() const;

private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
};

}  // namespace ballpit
