// Which encoder records: the best that this machine has.
#pragma once

#include <string>
#include <vector>

#include "common/libav.h"

namespace ballpit {

/// Software encoders this machine may have, best first: those for H.264, then mpeg4.
std::vector<std::string> preferredEncoders();

/// How small H.264 makes a file, from 0, exact, to 51, coarse (its "constant rate factor": six more
/// are half the size). Only libx264 obeys; above the usual it also takes its time.
constexpr int usualCompression = 20, mostCompression = 51;

/// An open encoder for a file of this format: the first of `names` that works here. InputError if
/// none does.
libav::Owned<AVCodecContext> openEncoder(const std::vector<std::string>& names, int width,
                                         int height, int framesPerSecond,
                                         const AVOutputFormat& format,
                                         int compression = usualCompression);

/// An empty picture as the encoder wants it.
libav::Owned<AVFrame> makePicture(const AVCodecContext& encoder);

}  // namespace ballpit
