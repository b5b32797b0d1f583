// The file of a recording: playable at every moment, and complete under its final name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/libav.h"

namespace ballpit {

/// Checks a path for a video: a known ending, an existing folder. Throws InputError.
void checkVideoPath(const std::filesystem::path& path);

/// While it is written, NAME.mp4 is NAME.part.mp4. MP4 and MOV are written in fragments, each with
/// an index of its own, so that the part plays even if the process is killed; complete() copies
/// them into a plain file with one index at its front, and gives that the final name.
class VideoFile {
public:
    explicit VideoFile(std::filesystem::path path);

    std::string path() const { return path_.string(); }

    const AVOutputFormat& format() const { return *file_->oformat; }

    /// Creates the part. InputError if it cannot be written.
    void open(const AVCodecContext& encoder);

    /// Appends a packet of that encoder. If it cannot be written, the part is cut back to what
    /// plays, and InputError says so.
    void write(AVPacket& packet);

    /// All packets are there: the file gets its final form and name. InputError if there is no
    /// room for that; the part stays then.
    void complete();

    /// After an exception: the part is closed properly and stays. Never throws.
    void leavePart() noexcept;

    /// Nothing stays. Never throws.
    void remove() noexcept;

private:
    void openPart();
    void writeHeader(const AVCodecContext& encoder);
    void finishPart();
    void cutToWhatPlays() noexcept;
    std::string whatIsLeft() const;
    bool isFragmented() const;

    std::filesystem::path path_, part_;
    libav::Owned<AVFormatContext> file_;
    AVRational encoderUnit_{};
    std::int64_t headerBytes_ = 0, safeBytes_ = 0;  // written for certain
};

}  // namespace ballpit
