// Looks at a video for `./ballpit videos`: what it is, single frames of it, a poster, a sheet.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "chapters/09_video_recording/contact_sheet.h"
#include "common/error.h"
#include "common/video_player.h"

using namespace ballpit;

namespace {

struct Wishes {
    std::string video, poster, sheet;
    std::vector<std::pair<std::size_t, std::string>> frames;
    std::size_t posterFrame = 0;
};

/// Half as wide and high: each pixel is the mean of four.
Frame halved(const Frame& frame) {
    Frame half{frame.width / 2, frame.height / 2, {}};
    const auto row = 3 * static_cast<std::size_t>(frame.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(half.height); ++y)
        for (std::size_t x = 0; x < static_cast<std::size_t>(half.width); ++x)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint8_t* p = frame.rgb.data() + 2 * y * row + 6 * x + c;
                half.rgb.push_back(
                    static_cast<std::uint8_t>((p[0] + p[3] + p[row] + p[row + 3] + 2) / 4));
            }
    return half;
}

void tell(const Video& video) {
    const nlohmann::ordered_json facts{
        {"codec", video.codec},
        {"width", video.width},
        {"height", video.height},
        {"frames", video.times.size()},
        {"frames_per_second", double(video.framesPerSecond) / video.perSeconds}};
    std::printf("%s\n", facts.dump().c_str());
}

int look(const Wishes& wishes) {
    const auto isFrame = [&](std::size_t number) {
        return [number](const auto& frame) { return frame.first == number; };
    };
    const Video facts = watchVideo(wishes.video, {}, [](std::size_t) { return false; });
    std::size_t number = 0;
    const auto wanted = [&](std::size_t k) {
        number = k;
        return (!wishes.poster.empty() && k == wishes.posterFrame) ||
               std::ranges::any_of(wishes.frames, isFrame(k));
    };
    const auto take = [&](const Frame& frame) {
        if (!wishes.poster.empty() && number == wishes.posterFrame)
            writePng(wishes.poster, halved(frame));
        for (const auto& [k, path] : wishes.frames)
            if (k == number) writePng(path, frame);
    };
    watchVideo(wishes.video, take, wanted);
    if (!wishes.sheet.empty()) {
        Frame sheet;
        playOntoSheet(wishes.video, static_cast<int>(facts.times.size()), sheet);
        writePng(wishes.sheet, sheet);
    }
    tell(facts);
    return exitOk;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Says what a video is, as JSON, and takes pictures out of it."};
    Wishes wishes;
    app.add_option("video", wishes.video)->required()->check(CLI::ExistingFile);
    app.add_option("--frame", wishes.frames, "N FILE.png: frame N, counted from 0");
    app.add_option("--poster", wishes.poster, "FILE.png: a frame, half as wide and high");
    app.add_option("--poster-frame", wishes.posterFrame, "which one");
    app.add_option("--sheet", wishes.sheet, "FILE.png: twelve frames at a glance");
    CLI11_PARSE(app, argc, argv);
    return reportingErrors([&] { return look(wishes); });
}
