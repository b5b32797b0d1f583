// A recording, decoded again: every frame is there, in order, upright and in its own colours.
#include "09_video_recording/video_recorder.h"
#include "common/error.h"
#include "tests/catch.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

using namespace ballpit;

namespace {

namespace fs = std::filesystem;

constexpr int width = 320, height = 180, rate = 60, count = 30;

using Color = std::array<int, 3>;
constexpr Color topLeft{220, 60, 30}, bottomRight{40, 80, 210};

/// Left and bottom, top and right differ, and the bar in the middle grows with the number.
Frame testFrame(int number) {
    Frame frame{width, height, {}};
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            Color color{128, 128, 128};
            if (row < height / 3 && column < width / 2) color = topLeft;
            if (row >= 2 * height / 3 && column >= width / 2) color = bottomRight;
            if (row >= height / 3 && row < 2 * height / 3 && column < 8 * (number + 1))
                color = {250, 250, 250};
            for (const int value : color) frame.rgb.push_back(static_cast<std::uint8_t>(value));
        }
    return frame;
}

/// What a player gets to see of a file.
struct Recording {
    std::string codec;
    int width = 0, height = 0, format = -1;
    AVRational rate{}, averageRate{};
    AVColorSpace colorSpace{};
    std::vector<double> times;    // of each frame, in frames
    std::vector<int> barLengths;  // in pixels
    std::vector<Color> topLefts, bottomRights;
};

/// BT.709 with luma from 16 to 235, back to RGB: the standard's formulas.
Color rgbAt(const AVFrame& picture, int column, int row) {
    const double y = (picture.data[0][row * picture.linesize[0] + column] - 16) / 219.0;
    const int chroma = row / 2 * picture.linesize[1] + column / 2;
    const double b = (picture.data[1][chroma] - 128) / 224.0;
    const double r = (picture.data[2][chroma] - 128) / 224.0;
    const auto byte = [](double value) { return static_cast<int>(std::lround(255.0 * value)); };
    return {byte(y + 1.5748 * r), byte(y - 0.1873 * b - 0.4681 * r), byte(y + 1.8556 * b)};
}

int barLength(const AVFrame& picture) {
    const std::uint8_t* line = picture.data[0] + picture.height / 2 * picture.linesize[0];
    return static_cast<int>(
        std::count_if(line, line + picture.width, [](std::uint8_t luma) { return luma > 180; }));
}

void note(Recording& recording, const AVFrame& picture, const AVStream& stream) {
    const auto pts = static_cast<double>(picture.best_effort_timestamp -
                                         std::max<std::int64_t>(stream.start_time, 0));
    recording.times.push_back(pts * av_q2d(stream.time_base) * av_q2d(stream.avg_frame_rate));
    recording.barLengths.push_back(barLength(picture));
    recording.topLefts.push_back(rgbAt(picture, 4, 4));
    recording.bottomRights.push_back(rgbAt(picture, picture.width - 5, picture.height - 5));
    recording.format = picture.format;
    recording.colorSpace = picture.colorspace;
}

Recording play(const fs::path& path) {
    INFO(path.string());
    AVFormatContext* file = nullptr;
    REQUIRE(avformat_open_input(&file, path.c_str(), nullptr, nullptr) == 0);
    REQUIRE(avformat_find_stream_info(file, nullptr) >= 0);
    REQUIRE(file->nb_streams == 1u);
    const AVStream& stream = *file->streams[0];
    const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
    AVCodecContext* decoder = avcodec_alloc_context3(codec);
    REQUIRE(avcodec_parameters_to_context(decoder, stream.codecpar) >= 0);
    REQUIRE(avcodec_open2(decoder, codec, nullptr) == 0);

    Recording recording;
    recording.codec = codec->name;
    recording.width = decoder->width;
    recording.height = decoder->height;
    recording.rate = stream.r_frame_rate;
    recording.averageRate = stream.avg_frame_rate;
    AVPacket* packet = av_packet_alloc();
    AVFrame* picture = av_frame_alloc();
    for (bool more = true; more;) {
        more = av_read_frame(file, packet) >= 0;
        REQUIRE(avcodec_send_packet(decoder, more ? packet : nullptr) >= 0);
        while (avcodec_receive_frame(decoder, picture) >= 0) note(recording, *picture, stream);
        av_packet_unref(packet);
    }
    av_frame_free(&picture);
    av_packet_free(&packet);
    avcodec_free_context(&decoder);
    avformat_close_input(&file);
    return recording;
}

bool isNear(Color a, Color b, int tolerance) {
    for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(a[i] - b[i]) > tolerance) return false;
    return true;
}

/// Complete, in order, upright, in the right colours.
void checkFrames(const Recording& recording, int expectedCount) {
    REQUIRE(recording.times.size() == static_cast<std::size_t>(expectedCount));
    for (int i = 0; i < expectedCount; ++i) {
        const auto k = static_cast<std::size_t>(i);
        CAPTURE(i, recording.topLefts[k], recording.bottomRights[k]);
        CHECK(recording.times[k] == Approx(i).margin(0.1));  // Matroska counts in milliseconds
        CHECK(recording.barLengths[k] == Approx(8 * (i + 1)).margin(2));
        CHECK(isNear(recording.topLefts[k], topLeft, 12));
        CHECK(isNear(recording.bottomRights[k], bottomRight, 12));
    }
}

struct TemporaryFolder {
    fs::path path = fs::temp_directory_path() / ("ballpit-video-" + std::to_string(getpid()));
    TemporaryFolder() { fs::create_directory(path); }
    ~TemporaryFolder() { fs::remove_all(path); }
    std::string operator/(const char* name) const { return (path / name).string(); }

    /// The names in it, so that a failure shows what was left behind.
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(path))
            found.push_back(entry.path().filename().string());
        std::ranges::sort(found);
        return found;
    }
};

using Names = std::vector<std::string>;

/// The message of the InputError that making such a recorder throws; empty if it throws none.
std::string refusal(const std::string& path, int w, int h, int framesPerSecond = rate,
                    const Names& encoders = preferredEncoders()) {
    try {
        VideoRecorder recorder(path, w, h, framesPerSecond, encoders);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

bool mentions(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos && text.find('\n') == std::string::npos;
}

}  // namespace

TEST_CASE("an MP4 recording has every frame, in order, upright and in its colours") {
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", width, height, rate);
    for (int i = 0; i < count; ++i) recorder.captureFrame(testFrame(i));
    CHECK(recorder.frameCount() == count);
    CHECK(folder.names() == Names{"movie.part.mp4"});
    recorder.release();
    CHECK(folder.names() == Names{"movie.mp4"});

    const Recording recording = play(folder / "movie.mp4");
    checkFrames(recording, count);
    CHECK(recording.width == width);
    CHECK(recording.height == height);
    CHECK(recording.format == AV_PIX_FMT_YUV420P);
    CHECK(recording.colorSpace == AVCOL_SPC_BT709);
    CHECK(av_cmp_q(recording.rate, {rate, 1}) == 0);
    CHECK(av_cmp_q(recording.averageRate, {rate, 1}) == 0);
    const bool fellBackToMpeg4 = recorder.encoderName() == "mpeg4";
    CHECK(recording.codec == (fellBackToMpeg4 ? "mpeg4" : "h264"));
    CHECK(recorder.notice().empty() == (recorder.encoderName() == "libx264"));
}

TEST_CASE("the other containers, and odd rates, keep every frame too") {
    const TemporaryFolder folder;
    for (const char* name : {"a.mkv", "a.mov", "a.avi", "A.MP4"})
        for (const int framesPerSecond : {25, 60, 144}) {
            CAPTURE(name, framesPerSecond);
            VideoRecorder recorder(folder / name, width, height, framesPerSecond);
            for (int i = 0; i < count; ++i) recorder.captureFrame(testFrame(i));
            recorder.release();
            const Recording recording = play(folder / name);
            checkFrames(recording, count);
            CHECK(av_q2d(recording.averageRate) == Approx(framesPerSecond).epsilon(0.001));
        }
}

TEST_CASE("the index of an MP4 file is in front, so that browsers can start at once") {
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", width, height, rate);
    for (int i = 0; i < count; ++i) recorder.captureFrame(testFrame(i));
    recorder.release();
    std::ifstream file(folder / "movie.mp4", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    REQUIRE(bytes.find("moov") != std::string::npos);
    CHECK(bytes.find("moov") < bytes.find("mdat"));
}

TEST_CASE("a single frame makes a video, and no frame makes none") {
    const TemporaryFolder folder;
    VideoRecorder one(folder / "one.mp4", width, height, rate);
    one.captureFrame(testFrame(0));
    one.release();
    one.release();
    CHECK(play(folder / "one.mp4").times.size() == 1u);
    CHECK_THROWS_AS(one.captureFrame(testFrame(1)), std::logic_error);

    VideoRecorder none(folder / "none.mp4", width, height, rate);
    CHECK_THROWS_AS(none.release(), InputError);
    { const VideoRecorder unused(folder / "unused.mp4", width, height, rate); }
    CHECK(folder.names() == Names{"one.mp4"});
}

TEST_CASE("an exception leaves a playable .part file and no final one") {
    const TemporaryFolder folder;
    try {
        VideoRecorder recorder(folder / "movie.mp4", width, height, rate);
        for (int i = 0; i < count; ++i) recorder.captureFrame(testFrame(i));
        throw std::runtime_error("the simulation failed");
    } catch (const std::runtime_error&) {
    }
    CHECK(folder.names() == Names{"movie.part.mp4"});
    checkFrames(play(folder / "movie.part.mp4"), count);
}

TEST_CASE("an earlier recording of that name stays until the new one is complete") {
    const TemporaryFolder folder;
    std::ofstream(folder / "movie.mp4") << "earlier";
    VideoRecorder recorder(folder / "movie.mp4", width, height, rate);
    recorder.captureFrame(testFrame(0));
    CHECK(fs::file_size(folder / "movie.mp4") == 7u);
    recorder.release();
    CHECK(fs::file_size(folder / "movie.mp4") > 7u);
}

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
    CHECK(mentions(refusal(folder / "folder.mp4", 320, 180), "folder"));
    fs::create_directory(folder / "taken.part.mp4");  // the temporary name cannot be opened
    CHECK(mentions(refusal(folder / "taken.mp4", 320, 180), folder / "taken.mp4"));
    CHECK(folder.names() == Names{"file.txt", "folder.mp4", "taken.part.mp4"});
}

TEST_CASE("without libx264 another encoder stands in and says so, and without any it is refused") {
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", width, height, rate, {"no-such-one", "mpeg4"});
    CHECK(recorder.encoderName() == "mpeg4");
    CHECK(mentions(recorder.notice(), "mpeg4"));
    for (int i = 0; i < count; ++i) recorder.captureFrame(testFrame(i));
    recorder.release();
    const Recording recording = play(folder / "movie.mp4");
    CHECK(recording.codec == "mpeg4");
    checkFrames(recording, count);

    CHECK(mentions(refusal(folder / "b.mp4", 320, 180, rate, {"no-such-one"}), "install"));
    CHECK(folder.names() == Names{"movie.mp4"});
    const Names encoders = preferredEncoders();
    CHECK(encoders.front() == "libx264");
    CHECK(encoders.back() == "mpeg4");
}

TEST_CASE("a frame of another size is refused, and the recording goes on") {
    const TemporaryFolder folder;
    VideoRecorder recorder(folder / "movie.mp4", width, height, rate);
    recorder.captureFrame(testFrame(0));
    Frame narrow = testFrame(1);
    narrow.width = width - 2;
    CHECK_THROWS_AS(recorder.captureFrame(narrow), std::invalid_argument);
    Frame truncated = testFrame(1);
    truncated.rgb.pop_back();
    CHECK_THROWS_AS(recorder.captureFrame(truncated), std::invalid_argument);
    recorder.captureFrame(testFrame(1));
    recorder.release();
    checkFrames(play(folder / "movie.mp4"), 2);
}

TEST_CASE("a full disk is an error, not a shorter video under the final name") {
    const TemporaryFolder folder;
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 2000;  // bytes: writing beyond fails, as on a full disk
    bool failed = false;
    {
        VideoRecorder recorder(folder / "movie.mp4", width, height, rate);
        setrlimit(RLIMIT_FSIZE, &small);
        try {
            for (int i = 0; i < count; ++i) recorder.captureFrame(testFrame(i));
            recorder.release();
        } catch (const std::runtime_error&) {
            failed = true;
        }
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(failed);
    CHECK(!fs::exists(folder / "movie.mp4"));
}
