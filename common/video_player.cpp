// Decodes by libav; the way back from YUV to RGB is the standard's formulas, so that it shares no
// mistake with the way there.
#include "common/video_player.h"

#include <algorithm>
#include <cmath>

#include "common/libav.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace ballpit {
namespace {

using libav::check;
using libav::Owned;

struct Close {
    void operator()(AVFormatContext* input) const { avformat_close_input(&input); }
};
using Input = std::unique_ptr<AVFormatContext, Close>;

std::string orEmpty(const char* text) { return text ? text : ""; }

Input openInput(const std::string& path) {
    AVFormatContext* context = nullptr;
    check(avformat_open_input(&context, path.c_str(), nullptr, nullptr), "playing '" + path + "'");
    Input input(context);
    check(avformat_find_stream_info(context, nullptr), "playing '" + path + "'");
    if (context->nb_streams != 1)
        throw std::runtime_error("playing '" + path + "' failed: it has not one stream, but " +
                                 std::to_string(context->nb_streams));
    return input;
}

Owned<AVCodecContext> openDecoder(const AVStream& stream) {
    const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
    if (!codec) throw std::runtime_error("playing a video failed: no decoder for it");
    Owned<AVCodecContext> decoder(avcodec_alloc_context3(codec));
    check(avcodec_parameters_to_context(decoder.get(), stream.codecpar), "playing a video");
    check(avcodec_open2(decoder.get(), codec, nullptr), "playing a video");
    return decoder;
}

std::uint8_t byteOf(double share) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(255.0 * share), 0l, 255l));
}

/// BT.709 with luma from 16 to 235, one chroma sample for two by two pixels.
Frame asFrame(const AVFrame& picture) {
    Frame frame{picture.width, picture.height, {}};
    frame.rgb.reserve(3 * static_cast<std::size_t>(frame.width) * frame.height);
    for (int row = 0; row < frame.height; ++row)
        for (int column = 0; column < frame.width; ++column) {
            const auto sample = [&](int plane, int x, int y) {
                return picture.data[plane][y * picture.linesize[plane] + x];
            };
            const double y = (sample(0, column, row) - 16) / 219.0;
            const double b = (sample(1, column / 2, row / 2) - 128) / 224.0;
            const double r = (sample(2, column / 2, row / 2) - 128) / 224.0;
            for (const double share : {y + 1.5748 * r, y - 0.1873 * b - 0.4681 * r, y + 1.8556 * b})
                frame.rgb.push_back(byteOf(share));
        }
    return frame;
}

Video factsOf(const AVStream& stream, const AVCodecContext& decoder) {
    Video video;
    video.codec = decoder.codec->name;
    video.width = decoder.width;
    video.height = decoder.height;
    video.framesPerSecond = stream.avg_frame_rate.num;
    video.perSeconds = stream.avg_frame_rate.den;
    return video;
}

}  // namespace

Video watchVideo(const std::string& path, const std::function<void(const Frame&)>& visit,
                 const std::function<bool(std::size_t)>& wanted) {
    const Input input = openInput(path);
    const AVStream& stream = *input->streams[0];
    const auto decoder = openDecoder(stream);
    const Owned<AVPacket> packet(av_packet_alloc());
    const Owned<AVFrame> picture(av_frame_alloc());
    Video video = factsOf(stream, *decoder);
    const std::int64_t start = std::max<std::int64_t>(stream.start_time, 0);
    for (bool more = true; more;) {
        more = av_read_frame(input.get(), packet.get()) >= 0;
        avcodec_send_packet(decoder.get(), more ? packet.get() : nullptr);
        av_packet_unref(packet.get());
        while (avcodec_receive_frame(decoder.get(), picture.get()) >= 0) {
            video.pixelFormat =
                orEmpty(av_get_pix_fmt_name(static_cast<AVPixelFormat>(picture->format)));
            video.colorSpace = orEmpty(av_color_space_name(picture->colorspace));
            video.colorRange = orEmpty(av_color_range_name(picture->color_range));
            video.times.push_back(static_cast<double>(picture->best_effort_timestamp - start) *
                                  av_q2d(stream.time_base));
            if (wanted(video.times.size() - 1)) visit(asFrame(*picture));
        }
    }
    return video;
}

PlayedVideo playVideo(const std::string& path) {
    PlayedVideo played;
    static_cast<Video&>(played) =
        watchVideo(path, [&](const Frame& frame) { played.frames.push_back(frame); });
    return played;
}

}  // namespace ballpit
