// A recording that something ends: an exception, kill -9, a full disk. What was recorded plays.
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <iostream>
#include <stdexcept>

#include "tests/recording.h"

using namespace ballpit;

namespace {

/// Files larger than this cannot be written in this scope, as on a full disk.
class SizeLimit {
public:
    explicit SizeLimit(std::uintmax_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        rlimit small = before_;
        small.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    SizeLimit(const SizeLimit&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int);
};

/// A test frame whose grey parts are noise, which no encoder makes small.
Frame noisyFrame(int number) {
    Frame frame = testFrame(number);
    std::uint32_t state = 1 + static_cast<std::uint32_t>(number);
    for (std::uint8_t& value : frame.rgb) {
        state = 1664525u * state + 1013904223u;
        if (value == 128) value = static_cast<std::uint8_t>(80 + (state >> 24) / 4);
    }
    return frame;
}

void captureNoisy(VideoRecorder& recorder) {
    for (int i = 0; i < testCount; ++i) recorder.captureFrame(noisyFrame(i));
}

/// How many bytes the part of these frames has.
std::uintmax_t partBytes(const TemporaryFolder& folder) {
    {
        VideoRecorder recorder(folder / "probe.mp4", testWidth, testHeight, testRate);
        captureNoisy(recorder);
    }
    const std::uintmax_t bytes = fs::file_size(folder / "probe.part.mp4");
    fs::remove(folder / "probe.part.mp4");
    return bytes;
}

/// A small file system of its own in a folder; false where this user may not mount one.
class SmallDisk {
public:
    SmallDisk(const fs::path& folder, std::uintmax_t bytes) : folder_(folder) {
        fs::create_directory(folder);
        const std::string size = "size=" + std::to_string(bytes);
        isMounted = mount("tmpfs", folder.c_str(), "tmpfs", 0, size.c_str()) == 0;
        if (!isMounted) std::cout << "SKIPPED: this user may not mount a small disk\n";
    }
    ~SmallDisk() {
        if (isMounted) umount(folder_.c_str());
    }
    SmallDisk(const SmallDisk&) = delete;
    bool isMounted = false;

private:
    fs::path folder_;
};

/// Plays, though not to the end. Packets are not in the order of the frames: where the file ends,
/// one of the last frames may be missing between others.
void checkBeginning(PlayedVideo video) {
    constexpr std::size_t reordered = 4;
    CHECK(video.frames.size() < std::size_t{testCount});
    REQUIRE(video.frames.size() > reordered);
    video.frames.resize(video.frames.size() - reordered);
    checkFrames(video);
}

/// Most bytes of memory that this process has ever used, in MB.
long peakMegabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

}  // namespace

TEST_CASE("an exception leaves a playable .part file and no final one") {
    const TemporaryFolder folder;
    try {
        VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
        captureAll(recorder);
        throw std::runtime_error("the simulation failed");
    } catch (const std::runtime_error&) {
    }
    CHECK(folder.names() == Names{"movie.part.mp4"});
    checkFrames(playVideo(folder / "movie.part.mp4"), testCount);
}

TEST_CASE("after kill -9 the part plays, in every container") {
    constexpr int numbered = 40, recorded = 120, heldBack = 60;  // queue, encoder, container
    const TemporaryFolder folder;
    for (const char* name : {"a.mp4", "b.mov", "c.mkv", "d.avi"}) {
        CAPTURE(name);
        const pid_t child = fork();
        if (child == 0) {
            VideoRecorder recorder(folder / name, testWidth, testHeight, testRate);
            for (int i = 0; i < recorded; ++i)
                recorder.captureFrame(testFrame(std::min(i, numbered - 1)));
            std::raise(SIGKILL);
        }
        int status = 0;
        waitpid(child, &status, 0);
        REQUIRE(WIFSIGNALED(status));
        CHECK(!fs::exists(folder / name));
        const fs::path path = folder / name;
        PlayedVideo video = playVideo(
            (path.parent_path() / (path.stem().string() + ".part" + path.extension().string()))
                .string());
        CHECK(video.frames.size() >= std::size_t{recorded - heldBack});
        video.frames.resize(std::min(video.frames.size(), std::size_t{numbered}));
        checkFrames(video);
    }
}

TEST_CASE("a full disk is an error that says what is left, and that plays") {
    const TemporaryFolder folder;
    const std::uintmax_t enough = partBytes(folder);
    std::string first, again;
    {
        VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
        const SizeLimit limit(enough / 2);
        first = refusalOf([&] {
            captureNoisy(recorder);
            recorder.release();
        });
        again = refusalOf([&] { recorder.release(); });
    }
    CHECK(mentions(first, "what was recorded until then plays: '" + (folder / "movie.part.mp4")));
    CHECK(again == first);
    CHECK(folder.names() == Names{"movie.part.mp4"});
    checkBeginning(playVideo(folder / "movie.part.mp4"));
}

TEST_CASE("a disk that is full before the first frame leaves no file") {
    const TemporaryFolder folder;
    {
        VideoRecorder recorder(folder / "movie.mp4", testWidth, testHeight, testRate);
        const SizeLimit limit(fs::file_size(folder / "movie.part.mp4") + 10);
        CHECK(mentions(refusalOf([&] {
                           captureNoisy(recorder);
                           recorder.release();
                       }),
                       "no frame was recorded yet"));
    }
    CHECK(folder.names().empty());
}

TEST_CASE("a disk too full for the final form keeps the whole part, and says so") {
    const TemporaryFolder folder;
    const std::uintmax_t part = partBytes(folder);
    const SmallDisk disk(folder.path / "disk", part + part / 2);
    if (!disk.isMounted) return;
    VideoRecorder recorder(folder / "disk/movie.mp4", testWidth, testHeight, testRate);
    captureNoisy(recorder);
    const std::string message = refusalOf([&] { recorder.release(); });
    CHECK(mentions(message, "No space left on device"));
    CHECK(mentions(message, "all of it is in '" + (folder / "disk/movie.part.mp4")));
    CHECK(!fs::exists(folder / "disk/movie.mp4"));
    checkFrames(playVideo(folder / "disk/movie.part.mp4"), testCount);
}

TEST_CASE("a disk that becomes full ends a recording with one line") {
    const TemporaryFolder folder;
    const std::uintmax_t part = partBytes(folder);
    const SmallDisk disk(folder.path / "disk", part / 2);
    if (!disk.isMounted) return;
    VideoRecorder recorder(folder / "disk/movie.mp4", testWidth, testHeight, testRate);
    const std::string message = refusalOf([&] {
        captureNoisy(recorder);
        recorder.release();
    });
    CHECK(mentions(message, "No space left on device"));
    checkBeginning(playVideo(folder / "disk/movie.part.mp4"));
}

TEST_CASE("a long recording takes no more memory than a short one") {
    // Frames come faster than they are encoded: without a bound, they would pile up.
    const TemporaryFolder folder;
    constexpr int width = 640, height = 360;
    Frame frame{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height)};
    for (std::size_t k = 0; k < frame.rgb.size(); ++k)
        frame.rgb[k] = static_cast<std::uint8_t>(k * k / 977);
    VideoRecorder recorder(folder / "movie.mp4", width, height, testRate);
    const auto record = [&](int frames) {
        for (int i = 0; i < frames; ++i) recorder.captureFrame(frame);
        return peakMegabytes();
    };
    const long afterFew = record(60), afterMany = record(600);
    CAPTURE(afterFew, afterMany);
    CHECK(afterMany - afterFew < 40);  // 600 frames have 415 MB
    recorder.release();
}
