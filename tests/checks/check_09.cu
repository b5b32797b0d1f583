// Checks of chapter 09: each stage alone, by hand; then whole recordings, decoded again by libav.
#include <algorithm>

#include "common/error.h"
#include "common/hole.cuh"
#include "common/offscreen_context.h"
#include "tests/checks/check.cuh"
#include "tests/checks/check_09_encode.cuh"
#include "tests/checks/check_09_video.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

const std::vector<Check> checks{
    {"read.pixels", "What was drawn arrives byte by byte, the bottom row first",
     "The encoder can only be as right as what it is given.", readPixelsExactly},
    {"read.unbound", "After start and after fetch no pixel buffer is bound or mapped",
     "While one is bound, every other read of pixels in the program goes into it. While one is "
     "mapped, nothing can be read into it.",
     leavesNothingBound},
    {"read.two", "Two frames under way arrive as they were drawn, the older one first",
     "The next frame is drawn while this one travels. With one buffer for both it would be painted "
     "over.",
     twoUnderWay},
    {"record.frame", "A frame is started when it was drawn, and handed on after the next",
     "So it has the time of a whole drawing to arrive, and nobody waits.", frameByFrame},
    {"record.last", "At the end everything that is still under way is handed on, in order",
     "One frame always is. Forgotten, the video is one frame short, and nobody notices.",
     restIsHandedOn},
    {"queue.order", "All that is pushed is popped, once and in order, whoever is slower",
     "A queue that loses a frame makes the video jump.", queueKeepsOrder},
    {"queue.full", "A push to a full queue waits until there is room",
     "Encoding is slower than drawing. Without waiting, ten minutes of 8 MB frames fill any "
     "memory.",
     queueIsBounded},
    {"queue.close", "Closing wakes who waits, and what was pushed before is popped first",
     "Else a program hangs at its end, or when the disk is full.", closingEndsIt},
    {"convert.table", "Six colours have the brightness, blueness and redness worked out by hand",
     "What is wrong for red is wrong for every ball that has some.", colorsByHand},
    {"convert.rows", "The rows of a picture are walked from the top one down",
     "OpenGL counts rows from below, video from above. A negative step turns a picture without "
     "moving a byte.",
     rowsByHand},
    {"convert.whole", "A whole picture has the standard's colours at every place",
     "Rows of an encoder's picture are longer than they look, and libswscale's colours are by "
     "default those of old televisions.",
     picturesConvert},
    {"encode.packets", "As many packets come out as pictures went in",
     "The encoder looks ahead: what it holds back must be asked for.", packetsComeOut},
    {"encode.stamps", "Times and durations are in the file's unit",
     "A player shows a frame when the file says so. In the wrong unit all is over in a moment.",
     timesByHand},
    {"video.order", "A recording has every frame once, in order, the last one too",
     "Each frame carries its number as a bar code, so that a decoded one can be told.",
     everyFrameInOrder},
    {"video.rate", "Frames, size, rate and times of the file are exact",
     "Ten seconds of simulation must take ten seconds to watch.", exactRate},
    {"video.upright", "What was drawn at the top left is at the top left of the video",
     "Four patches of different colours: one mistake each for upside down, mirrored and sheared.",
     upright},
    {"video.colors", "Colours come back as they were drawn, but for what compression takes",
     "Red must be red: channels, range and standard all show here.", rightColors},
    {"video.memory", "Frames from memory give the same video as drawn ones",
     "They come with three bytes a pixel and the top row first. The row of 118 pixels is no "
     "multiple of anything.",
     fromMemory}};

}  // namespace

int main(int argc, char** argv) {
    const bool onlyList = std::any_of(argv, argv + argc, [](const char* word) {
        return std::string(word) == "--list" || std::string(word) == "--help";
    });
    if (onlyList) return checkMain(argc, argv, "09", checks);
    return reportingErrors([&] {
        av_log_set_level(AV_LOG_FATAL);
        const OffscreenContext context;
        return checkMain(argc, argv, "09", checks);
    });
}
