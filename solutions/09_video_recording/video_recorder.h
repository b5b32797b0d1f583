// Turns frames into a video file: H.264 in MP4 wherever that is possible.
#pragma once

#include "09_video_recording/encoder_choice.h"
#include "common/frame.h"

#include <memory>
#include <string>
#include <vector>

namespace ballpit {

/// Records frames of one size at one constant rate. Frames are converted and encoded on a thread of
/// their own; a queue keeps a few of them and makes the drawing wait when the encoder is slower, so
/// that no frame is dropped and memory stays flat.
///
/// While it records, the file is named NAME.part.mp4 for a target NAME.mp4, and plays at every
/// moment, even after `kill -9`; release() completes it and gives it its name. So a file with the
/// final name is never half-written.
class VideoRecorder {
public:
    /// `path` ends in .mp4, .mkv, .mov or .avi; width and height are even. The first of `encoders`
    /// that works here is used. Throws InputError, leaving no file behind, if any of this cannot
    /// be.
    VideoRecorder(std::string path, int width, int height, int framesPerSecond,
                  const std::vector<std::string>& encoders = preferredEncoders(),
                  int compression = usualCompression);

    /// Without release(), after an exception: completes NAME.part.mp4, so that what was recorded
    /// can be played, but does not rename it. Never throws.
    ~VideoRecorder();

    /// Appends what is drawn in the framebuffer that is bound for reading, whose lower left corner
    /// is the frame's. Returns at once: the frame is read through pixel buffers while the next one
    /// is drawn. The OpenGL context must be current from the first call to release().
    void captureFrame();

    /// Appends a frame from memory. Throws std::invalid_argument if its size is not the recorder's.
    /// Both throw InputError if the file cannot be written, and std::runtime_error if the encoder
    /// fails: in this call or in a later one, since the encoder is some frames behind.
    void captureFrame(const Frame& frame);

    /// Waits for the encoder, completes the file and gives it its name; further calls do nothing.
    /// Throws InputError if no frame was captured (no player opens such a file) or the file cannot
    /// be written, and std::runtime_error if encoding fails.
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
