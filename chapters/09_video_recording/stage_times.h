// What each stage of a recording costs, and what two pixel buffers and a second thread save.
#pragma once

#include <GL/glew.h>

#include <filesystem>

#include "09_video_recording/capture.h"
#include "09_video_recording/encoder.h"
#include "09_video_recording/frame_converter.h"
#include "09_video_recording/pixel_reader.h"
#include "chapters/09_video_recording/clip.h"
#include "common/findings.h"
#include "common/timing.h"

namespace ballpit {

/// All in ms a frame.
struct StageTimes {
    double draw = 0, read = 0, convert = 0, encode = 0;
};

/// One stage after the other, each waiting for the one before.
inline StageTimes timeStages(const HoppingBalls& balls, int frames, int width, int height) {
    Studio studio(balls, width, height);
    PixelReader reader(width, height, PixelReader::Way::plain);
    FrameConverter converter(width, height, 4);
    const AVOutputFormat* format = av_guess_format("mp4", nullptr, nullptr);
    const auto encoder = openEncoder(preferredEncoders(), width, height, clipRate, *format);
    const auto picture = makePicture(*encoder);
    const libav::Owned<AVPacket> packet(av_packet_alloc());
    const auto drop = [](AVPacket& ready) { av_packet_unref(&ready); };
    Pixels pixels;
    StageTimes total;
    double since = milliseconds();
    const auto lap = [&] { return milliseconds() - std::exchange(since, milliseconds()); };
    for (int number = 0; number < frames; ++number) {
        studio.draw(number);
        glFinish();
        total.draw += lap();
        reader.start();
        reader.fetch(pixels);
        total.read += lap();
        libav::check(av_frame_make_writable(picture.get()), "a picture");
        converter.convert(pixels, *picture);
        total.convert += lap();
        encodePicture(*encoder, *picture, number, *packet, drop);
        total.encode += lap();
    }
    encodeRest(*encoder, *packet, drop);
    total.encode += lap();
    return {total.draw / frames, total.read / frames, total.convert / frames,
            total.encode / frames};
}

/// Drawing and reading alone, ms a frame.
inline double timeDrawAndRead(const HoppingBalls& balls, int frames, int width, int height,
                              PixelReader::Way way) {
    Studio studio(balls, width, height);
    PixelReader reader(width, height, way);
    Pixels pixels;
    const auto keep = [](Pixels&) {};
    const double start = milliseconds();
    for (int number = 0; number < frames; ++number) {
        studio.draw(number);
        captureDrawn(reader, pixels, keep);
    }
    captureRest(reader, pixels, keep);
    return (milliseconds() - start) / frames;
}

inline double timeRecorder(const HoppingBalls& balls, const std::string& path, int frames,
                           int width, int height) {
    const double start = milliseconds();
    recordClip(balls, path, frames, width, height);
    return (milliseconds() - start) / frames;
}

inline void addStageTimes(Findings& findings, const HoppingBalls& balls, const std::string& path) {
    constexpr int frames = 60, width = 1920, height = 1080;
    const StageTimes stages = timeStages(balls, frames, width, height);
    findings.add("draw, ms a frame", stages.draw);
    findings.add("read plainly, ms a frame", stages.read);
    findings.add("convert, ms a frame", stages.convert);
    findings.add("encode, ms a frame", stages.encode);
    findings.add("one after the other, ms a frame",
                 stages.draw + stages.read + stages.convert + stages.encode);
    for (const auto& [name, way] :
         {std::pair{"draw and read plainly, ms a frame", PixelReader::Way::plain},
          {"draw and read through buffers, ms a frame", PixelReader::Way::pixelBuffers}})
        findings.add(name, timeDrawAndRead(balls, frames, width, height, way));
    const double recorder = timeRecorder(balls, path, frames, width, height);
    findings.add("recorder, ms a frame", recorder);
    findings.add("recorder, frames a second", 1000 / recorder);
}

}  // namespace ballpit
