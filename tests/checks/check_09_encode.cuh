// Chapter 09: what goes into an encoder comes out of it, and when.
#pragma once

#include <set>

#include "09_video_recording/encoder.h"
#include "09_video_recording/encoder_choice.h"
#include "tests/checks/check_09_convert.cuh"
#include "tests/checks/check_09_queue.cuh"

namespace ballpit::check {

/// Ten pictures encoded one by one.
struct Encoded {
    libav::Owned<AVCodecContext> encoder = openEncoder(
        preferredEncoders(), testWidth, testHeight, 60, *av_guess_format("mp4", nullptr, nullptr));
    libav::Owned<AVPacket> packet{av_packet_alloc()};
    std::vector<std::int64_t> times;  // of the packets written, in frames
    std::size_t beforeTheEnd = 0;

    void note(AVPacket& ready) {
        times.push_back(ready.pts);
        av_packet_unref(&ready);
    }
    void run(int count) {
        const auto write = [&](AVPacket& ready) { note(ready); };
        for (int k = 0; k < count; ++k) {
            const auto picture = paddedPicture(testWidth, testHeight);
            FrameConverter(testWidth, testHeight, 3)
                .convert(asPixels(numberedFrame(k), 3, false), *picture);
            encodePicture(*encoder, *picture, k, *packet, write);
        }
        beforeTheEnd = times.size();
        encodeRest(*encoder, *packet, write);
    }
    /// What is still in the encoder when all should be out.
    std::size_t leftInside() {
        avcodec_send_frame(encoder.get(), nullptr);
        std::size_t count = 0;
        for (; avcodec_receive_packet(encoder.get(), packet.get()) >= 0; ++count)
            av_packet_unref(packet.get());
        return count;
    }
};

inline std::shared_ptr<Encoded> encoded(Report& report, int count) {
    auto encoded = std::make_shared<Encoded>();
    Background work([=] { encoded->run(count); });
    if (work.ends()) return encoded;
    report.fail("encoding " + text(count) +
                " pictures does not end: EAGAIN means no packet yet, "
                "EOF means none any more");
    return nullptr;
}

inline void packetsComeOut(Report& report) {
    for (const int count : {1, 2, 40}) {
        const auto all = encoded(report, count);
        if (!all) return;
        const std::size_t written = all->times.size(), left = all->leftInside();
        const std::string of = " of " + text(count) + " pictures";
        if (written != static_cast<std::size_t>(count))
            report.fail("packets written" + of,
                        text(written) + ", " + text(all->beforeTheEnd) + " of them before the end",
                        text(count));
        const std::set<std::int64_t> different(all->times.begin(), all->times.end());
        if (written == static_cast<std::size_t>(count) && different.size() != written)
            report.fail("different times" + of, text(different.size()), text(count));
        report.guess(
            {{"nothing is received from the encoder", [&] { return written == 0 && left; }},
             {"the last packets are not drained: the encoder still holds " + text(left),
              [&] { return left > 0; }},
             {"packets are taken from the encoder, but not written",
              [&] { return written < static_cast<std::size_t>(count); }}});
        if (report.failed()) return;
        if (count == 40)
            report.measured("40 pictures in: " + text(all->beforeTheEnd) +
                            " packets had come out before the end was told, " +
                            text(written - all->beforeTheEnd) + " after");
    }
}

inline void timesByHand(Report& report) {
    struct Row {
        int rate, ticks;
        std::int64_t pts, dts, duration;
    };
    for (const Row& row : {Row{60, 15360, 1280, 768, 256}, Row{25, 12800, 2560, 1536, 512},
                           Row{60, 60, 5, 3, 1}, Row{60, 1000, 83, 50, 17}}) {
        const libav::Owned<AVPacket> packet(av_packet_alloc());
        packet->pts = 5;
        packet->dts = 3;
        stampPacket(*packet, {1, row.rate}, {1, row.ticks});
        const std::string which =
            " of frame 5 at " + text(row.rate) + " frames a second, in 1/" + text(row.ticks) + " s";
        const auto compare = [&](const char* what, std::int64_t got, std::int64_t expected) {
            if (got != expected)
                report.fail(what + which, std::to_string(got), std::to_string(expected));
        };
        compare("time to show", packet->pts, row.pts);
        compare("time to decode", packet->dts, row.dts);
        compare("duration", packet->duration, row.duration);
        report.guess({{"not rescaled: the file takes frames for its own, shorter ticks",
                       [&] { return packet->pts == 5 && row.ticks != row.rate; }},
                      {"the duration is set after rescaling, or not at all",
                       [&] { return packet->pts == row.pts && packet->dts == row.dts; }},
                      {"only one of a packet's two times is rescaled",
                       [&] { return (packet->pts == row.pts) != (packet->dts == row.dts); }}});
    }
}

}  // namespace ballpit::check
