// From pictures to packets: what goes into an encoder comes out later, and in another order.
#pragma once

#include <cstdint>

#include "common/hole.cuh"
#include "common/libav.h"

namespace ballpit {

/// Gives everything that the encoder has ready to `write`: often nothing, sometimes several
/// packets.
template <class Write>
void drainEncoder(AVCodecContext& encoder, AVPacket& packet, Write write) {
    // ---- hole encode.drain (about 6 lines): Receive packets until there is none: EAGAIN, or EOF at the end
    TODO_HOLE("encode.drain");
    // ---- end of encode.drain
}

/// Encodes frame `number`. The encoder looks some frames ahead before it writes one.
template <class Write>
void encodePicture(AVCodecContext& encoder, AVFrame& picture, std::int64_t number, AVPacket& packet,
                   Write write) {
    picture.pts = number;  // the frame's time, in the encoder's unit: one frame
    libav::check(avcodec_send_frame(&encoder, &picture), "video: encoding a frame");
    drainEncoder(encoder, packet, write);
}

/// There are no more frames: what the encoder still holds comes out.
template <class Write>
void encodeRest(AVCodecContext& encoder, AVPacket& packet, Write write) {
    // ---- hole encode.rest (about 2 lines): Send no picture at all: that means the end. Then drain
    TODO_HOLE("encode.rest");
    // ---- end of encode.rest
}

/// A packet's times in the file's unit. The encoder counts frames (1/60 s each), MP4 counts
/// shorter ticks (often 1/15360 s), and the file chooses which.
inline void stampPacket(AVPacket& packet, AVRational encoderUnit, AVRational fileUnit) {
    // ---- hole encode.times (about 2 lines): It lasts one frame; rescale its times to the file's unit
    TODO_HOLE("encode.times");
    // ---- end of encode.times
}

}  // namespace ballpit
