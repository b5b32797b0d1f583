// Reads packets from one container and writes them into another.
#include "09_video_recording/stream_copy.h"

#include "common/libav.h"

namespace ballpit {

using libav::check;
using libav::Owned;

namespace {

Owned<AVFormatContext> openOutput(const std::filesystem::path& path, const AVStream& source) {
    AVFormatContext* context = nullptr;
    check(avformat_alloc_output_context2(&context, nullptr, nullptr, path.c_str()),
          "choosing a format");
    Owned<AVFormatContext> output(context);
    AVStream* stream = avformat_new_stream(context, nullptr);
    check(avcodec_parameters_copy(stream->codecpar, source.codecpar), "describing the video");
    stream->codecpar->codec_tag = 0;  // the format has its own
    stream->time_base = source.time_base;
    stream->avg_frame_rate = source.avg_frame_rate;
    stream->r_frame_rate = source.r_frame_rate;
    check(avio_open(&context->pb, path.c_str(), AVIO_FLAG_WRITE), "opening it");
    AVDictionary* options = nullptr;
    av_dict_set(&options, "movflags", "+faststart", 0);
    const int result = avformat_write_header(context, &options);
    av_dict_free(&options);
    check(result, "writing its header");
    return output;
}

}  // namespace

void copyStream(const std::filesystem::path& from, const std::filesystem::path& to) {
    AVFormatContext* context = nullptr;
    check(avformat_open_input(&context, from.c_str(), nullptr, nullptr), "reading it again");
    const std::unique_ptr<AVFormatContext, void (*)(AVFormatContext*)> input(
        context, [](AVFormatContext* open) { avformat_close_input(&open); });
    check(avformat_find_stream_info(context, nullptr), "reading it again");
    const AVStream& source = *context->streams[0];
    const auto output = openOutput(to, source);
    const Owned<AVPacket> packet(av_packet_alloc());
    std::int64_t start = AV_NOPTS_VALUE;  // a fragmented file shifts its times: none is below 0
    while (av_read_frame(context, packet.get()) >= 0) {
        if (start == AV_NOPTS_VALUE) start = packet->pts;
        packet->pts -= start;
        packet->dts -= start;
        av_packet_rescale_ts(packet.get(), source.time_base, output->streams[0]->time_base);
        packet->pos = -1;
        check(av_interleaved_write_frame(output.get(), packet.get()), "writing it");
    }
    check(av_write_trailer(output.get()), "writing its index");
    check(avio_closep(&output->pb), "closing it");
}

}  // namespace ballpit
