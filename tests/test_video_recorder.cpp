// A recording, decoded again: every frame is there, in order, upright and in its own colours.
#include "tests/recording.h"

#include <GL/glew.h>

#include <fstream>
#include <stdexcept>

#include "common/offscreen_context.h"

using namespace ballpit;

TEST_CASE("an MP4 recording has every frame, in order, upright and in its colours") {
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
    captureAll(recorder);
    CHECK(recorder.frameCount() == testCount);
    CHECK(folder.names() == Names{"movie.part.mp4"});
    recorder.release();
    CHECK(folder.names() == Names{"movie.mp4"});

    const PlayedVideo recording = playVideo(folder / "movie.mp4");
    checkFrames(recording, testCount);
    CHECK(recording.width == testWidth);
    CHECK(recording.height == testHeight);
    CHECK(recording.pixelFormat == "yuv420p");
    CHECK(recording.colorSpace == "bt709");
    CHECK(recording.colorRange == "tv");
    CHECK(recording.framesPerSecond == testRate);
    CHECK(recording.perSeconds == 1);
    const bool fellBackToMpeg4 = recorder.encoderName() == "mpeg4";
    CHECK(recording.codec == (fellBackToMpeg4 ? "mpeg4" : "h264"));
    CHECK(recorder.notice().empty() == (recorder.encoderName() == "libx264"));
}

TEST_CASE("the other containers, and odd rates, keep every frame too") {
    const TemporaryFolder folder;
    for (const char* name : {"a.mkv", "a.mov", "a.avi", "A.MP4"})
        for (const int framesPerSecond : {25, 60, 144}) {
            CAPTURE(name, framesPerSecond);
            VideoRecorder recorder(folder / name, testWidth, testHeight, framesPerSecond);
            captureAll(recorder);
            recorder.release();
            const PlayedVideo recording = playVideo(folder / name);
            checkFrames(recording, testCount);
            CHECK(double(recording.framesPerSecond) / recording.perSeconds ==
                  Approx(framesPerSecond).epsilon(0.001));
        }
}

TEST_CASE("the index of an MP4 file is in front, so that browsers can start at once") {
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
    captureAll(recorder);
    recorder.release();
    std::ifstream file(folder / "movie.mp4", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    REQUIRE(bytes.find("moov") != std::string::npos);
    CHECK(bytes.find("moov") < bytes.find("mdat"));
}

TEST_CASE("a single frame makes a video, and no frame makes none") {
    const TemporaryFolder folder;
    VideoRecorder one(folder / "one.mp4", testWidth, testHeight, testRate);
    one.captureFrame(testFrame(0));
    one.release();
    one.release();
    CHECK(playVideo(folder / "one.mp4").frames.size() == 1u);
    CHECK_THROWS_AS(one.captureFrame(testFrame(1)), std::logic_error);

    VideoRecorder none(folder / "none.mp4", testWidth, testHeight, testRate);
    CHECK_THROWS_AS(none.release(), InputError);
    { const VideoRecorder unused(folder / "unused.mp4", testWidth, testHeight, testRate); }
    CHECK(folder.names() == Names{"one.mp4"});
}

TEST_CASE("an earlier recording of that name stays until the new one is complete") {
    const TemporaryFolder folder;
    std::ofstream(folder / "movie.mp4") << "earlier";
    VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
    recorder.captureFrame(testFrame(0));
    CHECK(fs::file_size(folder / "movie.mp4") == 7u);
    recorder.release();
    CHECK(fs::file_size(folder / "movie.mp4") > 7u);
}

TEST_CASE("a frame of another size is refused, and the recording goes on") {
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
    recorder.captureFrame(testFrame(0));
    Frame narrow = testFrame(1);
    narrow.width = testWidth - 2;
    CHECK_THROWS_AS(recorder.captureFrame(narrow), std::invalid_argument);
    Frame truncated = testFrame(1);
    truncated.rgb.pop_back();
    CHECK_THROWS_AS(recorder.captureFrame(truncated), std::invalid_argument);
    recorder.captureFrame(testFrame(1));
    recorder.release();
    checkFrames(playVideo(folder / "movie.mp4"), 2);
}

namespace {

/// A framebuffer that shows what a test frame shows.
struct Easel {
    unsigned framebuffer = 0, pixels = 0;
    Easel() {
        glGenFramebuffers(1, &framebuffer);
        glGenRenderbuffers(1, &pixels);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glBindRenderbuffer(GL_RENDERBUFFER, pixels);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, testWidth, testHeight);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels);
        glEnable(GL_SCISSOR_TEST);
    }
    ~Easel() {
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteRenderbuffers(1, &pixels);
    }
    Easel(const Easel&) = delete;

    /// Rows are counted from above.
    static void paint(int left, int top, int right, int bottom, Color color) {
        glScissor(left, testHeight - bottom, right - left, bottom - top);
        glClearColor(static_cast<float>(color[0]) / 255, static_cast<float>(color[1]) / 255,
                     static_cast<float>(color[2]) / 255, 1);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    static void show(int number) {
        paint(0, 0, testWidth, testHeight, {128, 128, 128});
        paint(0, 0, testWidth / 2, testHeight / 3, topLeft);
        paint(testWidth / 2, 2 * testHeight / 3, testWidth, testHeight, bottomRight);
        paint(0, testHeight / 3, 8 * (number + 1), 2 * testHeight / 3, {250, 250, 250});
    }
};

}  // namespace

TEST_CASE("frames read from the framebuffer are all there, and mix with frames from memory") {
    const OffscreenContext context;
    const Easel easel;
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
    for (int i = 0; i < testCount; ++i) {
        Easel::show(i);
        i % 7 == 3 ? recorder.captureFrame(testFrame(i)) : recorder.captureFrame();
    }
    CHECK(recorder.frameCount() == testCount);
    recorder.release();
    checkFrames(playVideo(folder / "movie.mp4"), testCount);
}

TEST_CASE("drawn frames survive an exception, the last one too") {
    const OffscreenContext context;
    const Easel easel;
    const TemporaryFolder folder;
    {
        VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
        for (int i = 0; i < testCount; ++i) {
            Easel::show(i);
            recorder.captureFrame();
        }
    }
    CHECK(folder.names() == Names{"movie.part.mp4"});
    checkFrames(playVideo(folder / "movie.part.mp4"), testCount);
}

TEST_CASE("with no framebuffer to read from, a capture is refused") {
    const OffscreenContext context;
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
    CHECK_THROWS_AS(recorder.captureFrame(), std::logic_error);
}
