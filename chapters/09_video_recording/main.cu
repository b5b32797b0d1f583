// Chapter 09's executable: records a clip of hopping balls, and plays it to see what is in it.
#include <iostream>

#include "chapters/09_video_recording/color_block.h"
#include "chapters/09_video_recording/contact_sheet.h"
#include "chapters/09_video_recording/stage_times.h"
#include "common/error.h"
#include "common/metrics.h"
#include "common/options.h"

using namespace ballpit;

namespace {

int run(const Options& options) {
    const HoppingBalls balls(options.count, options.seed);
    if (!options.stills.empty()) return keepStills(balls, options), exitOk;
    const ClipFile file(options.out);
    std::cerr << "recorded with "
              << recordClip(balls, file.path, options.frames, options.width, options.height)
              << '\n';
    Frame sheet;
    const Video video = playOntoSheet(file.path, options.frames, sheet);

    Findings findings("09 video_recording");
    findings.add("balls", std::int64_t{options.count});
    findings.add("frames drawn", std::int64_t{options.frames});
    findings.add("frames played", static_cast<std::int64_t>(video.times.size()));
    findings.add("size", std::to_string(video.width) + "x" + std::to_string(video.height));
    findings.add("frames a second", double(video.framesPerSecond) / video.perSeconds);
    findings.add("last frame at, s", video.times.empty() ? 0.0 : video.times.back());
    findings.add("picture", video.pixelFormat + ", " + video.colorSpace + ", " + video.colorRange);
    findings.add("bytes drawn", std::int64_t{3} * options.width * options.height * options.frames);
    findings.add("state hash", hashText(stateHash(balls.at(options.frames - 1))));
    addBlock(findings);
    if (options.time) addStageTimes(findings, balls, file.path);
    findings.print(options.json);
    if (!options.png.empty()) writePng(options.png, sheet);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return runChapter(argc, argv, "From pixels to a video file.",
                      {.count = 40, .frames = 60, .width = 320, .height = 180, .timedCount = 500},
                      run);
}
