// PNG files, by libavcodec's encoder: the recorder needs that library anyway.
#include "common/frame.h"

#include "common/error.h"
#include "common/libav.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace ballpit {
namespace {

using libav::check;
using libav::Owned;

Owned<AVCodecContext> openEncoder(int width, int height) {
    const AVCodec* codec = avcodec_find_encoder(AV_CODEC_ID_PNG);
    if (!codec)
        throw InputError("PNG: this build of libavcodec has no PNG encoder; install ffmpeg");
    Owned<AVCodecContext> context(avcodec_alloc_context3(codec));
    context->width = width;
    context->height = height;
    context->pix_fmt = AV_PIX_FMT_RGB24;
    context->time_base = {1, 1};
    context->thread_count = 1;  // the threaded encoder would want a second frame first
    check(avcodec_open2(context.get(), codec, nullptr), "PNG: opening the encoder");
    return context;
}

/// The whole PNG file, as one packet.
Owned<AVPacket> encode(const Frame& frame) {
    const auto encoder = openEncoder(frame.width, frame.height);
    Owned<AVFrame> picture(av_frame_alloc());
    picture->width = frame.width;
    picture->height = frame.height;
    picture->format = AV_PIX_FMT_RGB24;
    // The encoder only reads: it copies a frame that is not reference-counted.
    picture->data[0] = const_cast<std::uint8_t*>(frame.rgb.data());
    picture->linesize[0] = 3 * frame.width;

    Owned<AVPacket> packet(av_packet_alloc());
    check(avcodec_send_frame(encoder.get(), picture.get()), "PNG: sending the frame");
    check(avcodec_send_frame(encoder.get(), nullptr), "PNG: flushing");
    check(avcodec_receive_packet(encoder.get(), packet.get()), "PNG: encoding");
    return packet;
}

[[noreturn]] void failToWrite(const std::string& path, const std::string& why) {
    throw InputError("cannot write the picture '" + path + "': " + why +
                     "; name a file in an existing folder that you may write to");
}

}  // namespace

void writePng(const std::string& path, const Frame& frame) {
    const auto expected = 3 * static_cast<std::size_t>(frame.width) * frame.height;
    if (frame.width <= 0 || frame.height <= 0 || frame.rgb.size() != expected)
        throw std::invalid_argument("writePng: the frame's bytes are not 3 * width * height");
    if (std::filesystem::is_directory(path)) failToWrite(path, "it is a folder");
    const auto packet = encode(frame);

    const std::string part = path + ".part";
    std::ofstream file(part, std::ios::binary);
    if (!file) failToWrite(path, std::strerror(errno));
    file.write(reinterpret_cast<const char*>(packet->data), packet->size);
    file.close();
    std::error_code error;
    if (!file) error = std::make_error_code(std::errc::no_space_on_device);
    if (!error) std::filesystem::rename(part, path, error);
    if (!error) return;
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    failToWrite(path, error.message());
}

}  // namespace ballpit
