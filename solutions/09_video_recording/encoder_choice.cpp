// Opens an encoder and tells it what we record.
#include "09_video_recording/encoder_choice.h"

#include "common/error.h"

#include <algorithm>
#include <utility>

extern "C" {
#include <libavutil/opt.h>
}

namespace ballpit {

using libav::check;
using libav::Owned;

namespace {

void chooseQuality(AVCodecContext& encoder, int compression) {
    if (std::string(encoder.codec->name) == "libx264") {
        // 10 ms a frame at 1920x1080 with 500 balls on two cores; finer presets take longer.
        const char* preset = compression > usualCompression ? "slow" : "veryfast";
        av_opt_set(encoder.priv_data, "preset", preset, 0);
        av_opt_set(encoder.priv_data, "crf", std::to_string(compression).c_str(), 0);
    } else if (encoder.codec_id == AV_CODEC_ID_MPEG4) {
        encoder.flags |= AV_CODEC_FLAG_QSCALE;
        encoder.global_quality = 3 * FF_QP2LAMBDA;
    } else {
        encoder.bit_rate = encoder.width * std::int64_t{encoder.height} * encoder.framerate.num / 6;
    }
}

/// Hardware encoders are left out: they want a device and other picture formats.
bool isUsable(const AVCodec& codec) {
    if (codec.capabilities & (AV_CODEC_CAP_HARDWARE | AV_CODEC_CAP_HYBRID)) return false;
    for (const AVPixelFormat* format = codec.pix_fmts; format && *format != AV_PIX_FMT_NONE;
         ++format)
        if (*format == AV_PIX_FMT_YUV420P) return true;
    return false;
}

/// An open encoder of that name; null if this machine has none that works.
Owned<AVCodecContext> tryEncoder(const std::string& name, int width, int height,
                                 int framesPerSecond, const AVOutputFormat& format,
                                 int compression) {
    const AVCodec* codec = avcodec_find_encoder_by_name(name.c_str());
    if (!codec) return nullptr;
    Owned<AVCodecContext> encoder(avcodec_alloc_context3(codec));
    encoder->width = width;
    encoder->height = height;
    encoder->pix_fmt = AV_PIX_FMT_YUV420P;
    encoder->time_base = {1, framesPerSecond};
    encoder->framerate = {framesPerSecond, 1};
    encoder->gop_size = 2 * framesPerSecond;  // players can jump to any two seconds
    encoder->sample_aspect_ratio = {1, 1};
    encoder->color_range = AVCOL_RANGE_MPEG;
    encoder->colorspace = AVCOL_SPC_BT709;
    encoder->color_primaries = AVCOL_PRI_BT709;
    encoder->color_trc = AVCOL_TRC_BT709;
    if (format.flags & AVFMT_GLOBALHEADER) encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    // AVI stores no display times, so its frames must come in the order in which they are shown.
    if (std::string(format.name) == "avi") encoder->max_b_frames = 0;
    chooseQuality(*encoder, compression);
    return avcodec_open2(encoder.get(), codec, nullptr) >= 0 ? std::move(encoder) : nullptr;
}

}  // namespace

Owned<AVCodecContext> openEncoder(const std::vector<std::string>& names, int width, int height,
                                  int framesPerSecond, const AVOutputFormat& format,
                                  int compression) {
    for (const std::string& name : names)
        if (auto encoder = tryEncoder(name, width, height, framesPerSecond, format, compression))
            return encoder;
    throw InputError("video: no encoder here can record " + std::to_string(width) + "x" +
                     std::to_string(height) + "; install ffmpeg with libx264");
}

Owned<AVFrame> makePicture(const AVCodecContext& encoder) {
    Owned<AVFrame> picture(av_frame_alloc());
    picture->width = encoder.width;
    picture->height = encoder.height;
    picture->format = encoder.pix_fmt;
    picture->color_range = encoder.color_range;
    picture->colorspace = encoder.colorspace;
    check(av_frame_get_buffer(picture.get(), 0), "video: allocating a picture");
    return picture;
}

std::vector<std::string> preferredEncoders() {
    std::vector<std::string> names{"libx264", "libopenh264"};
    void* position = nullptr;
    while (const AVCodec* codec = av_codec_iterate(&position))
        if (codec->id == AV_CODEC_ID_H264 && av_codec_is_encoder(codec) && isUsable(*codec) &&
            std::ranges::find(names, codec->name) == names.end())
            names.emplace_back(codec->name);
    names.emplace_back("mpeg4");
    return names;
}

}  // namespace ballpit
