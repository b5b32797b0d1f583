// What cannot be recorded is refused in one line, and leaves nothing behind.
#include <fstream>

#include "tests/recording.h"

using namespace ballpit;

namespace {

/// The message of the InputError that making such a recorder throws; empty if it throws none.
std::string refusal(const std::string& path, int w, int h, int framesPerSecond = testRate,
                    const Names& encoders = preferredEncoders()) {
    return refusalOf([&] { VideoRecorder(path, w, h, framesPerSecond, encoders); });
}

}  // namespace

TEST_CASE("bad input is refused in one line that says what would be right") {
    const TemporaryFolder folder;
    CHECK(mentions(refusal(folder / "movie.gif", 320, 180), ".mp4, .mkv, .mov or .avi"));
    CHECK(mentions(refusal(folder / "movie", 320, 180), ".mp4, .mkv, .mov or .avi"));
    CHECK(mentions(refusal(folder / "movie.mp4", 321, 180), "320x180"));
    CHECK(mentions(refusal(folder / "movie.mp4", 320, 181), "320x180"));
    CHECK(mentions(refusal(folder / "movie.mp4", 1, 2), "2x2"));
    CHECK(mentions(refusal(folder / "movie.mp4", 0, 180), "at least 2"));
    CHECK(mentions(refusal(folder / "movie.mp4", 320, -2), "at least 2"));
    CHECK(mentions(refusal(folder / "movie.mp4", 320, 180, 0), "at least 1"));
    CHECK(mentions(refusal(folder / "missing/movie.mp4", 320, 180),
                   "no folder '" + (folder / "missing") + "'"));
    CHECK(folder.names().empty());
}

TEST_CASE("places that cannot be written are refused, and nothing is left there") {
    const TemporaryFolder folder;
    std::ofstream(folder / "file.txt") << "not a folder";
    CHECK(mentions(refusal(folder / "file.txt/movie.mp4", 320, 180), folder / "file.txt"));
    fs::create_directory(folder / "folder.mp4");
    CHECK(mentions(refusal(folder / "folder.mp4", 320, 180), "this is a folder"));
    fs::create_directory(folder / "taken.part.mp4");  // the temporary name cannot be opened
    CHECK(mentions(refusal(folder / "taken.mp4", 320, 180), folder / "taken.mp4"));
    CHECK(folder.names() == Names{"file.txt", "folder.mp4", "taken.part.mp4"});
}

TEST_CASE("without libx264 another encoder stands in and says so, and without any it is refused") {
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate,
                           {"no-such-one", "mpeg4"});
    CHECK(recorder.encoderName() == "mpeg4");
    CHECK(mentions(recorder.notice(), "mpeg4"));
    captureAll(recorder);
    recorder.release();
    const PlayedVideo recording = playVideo(folder / "movie.mp4");
    CHECK(recording.codec == "mpeg4");
    checkFrames(recording, testCount);

    CHECK(mentions(refusal(folder / "b.mp4", 320, 180, testRate, {"no-such-one"}), "install"));
    CHECK(folder.names() == Names{"movie.mp4"});
    const Names encoders = preferredEncoders();
    CHECK(encoders.front() == "libx264");
    CHECK(encoders.back() == "mpeg4");
}
