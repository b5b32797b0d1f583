// From pictures to packets: what goes into an encoder comes out later, and in another order.
#pragma once

#include <cstdint>

//@starter #include "common/hole.cuh"
#include "common/libav.h"

namespace ballpit {

/// Gives everything that the encoder has ready to `write`: often nothing, sometimes several
/// packets.
template <class Write>
void drainEncoder(AVCodecContext& encoder, AVPacket& packet, Write write) {
    //@hole encode.drain lines=6 "Receive packets until there is none: EAGAIN, or EOF at the end"
    //@starter TODO_HOLE("encode.drain");
    while (true) {
        const int result = avcodec_receive_packet(&encoder, &packet);
        if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
        libav::check(result, "video: encoding");
        write(packet);
    }
    //@end
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
    //@hole encode.rest lines=2 "Send no picture at all: that means the end. Then drain"
    //@starter TODO_HOLE("encode.rest");
    libav::check(avcodec_send_frame(&encoder, nullptr), "video: encoding the last frames");
    drainEncoder(encoder, packet, write);
    //@end
}

/// A packet's times in the file's unit. The encoder counts frames (1/60 s each), MP4 counts
/// shorter ticks (often 1/15360 s), and the file chooses which.
inline void stampPacket(AVPacket& packet, AVRational encoderUnit, AVRational fileUnit) {
    //@hole encode.times lines=2 "It lasts one frame; rescale its times to the file's unit"
    //@starter TODO_HOLE("encode.times");
    packet.duration = 1;
    av_packet_rescale_ts(&packet, encoderUnit, fileUnit);
    //@end
}

}  // namespace ballpit
