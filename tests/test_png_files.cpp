// PNG files: their pixels, and that a failure leaves nothing behind.
#include "common/error.h"
#include "common/frame.h"
#include "tests/pictures.h"

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

extern "C" {
#include <libavcodec/avcodec.h>
}

using namespace ballpit;

namespace {

namespace fs = std::filesystem;

struct TemporaryFolder {
    fs::path path = fs::temp_directory_path() / ("ballpit-picture-" + std::to_string(getpid()));
    TemporaryFolder() { fs::create_directory(path); }
    ~TemporaryFolder() { fs::remove_all(path); }
    bool empty() const { return fs::is_empty(path); }
};

std::vector<std::uint8_t> bytesOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The pixels of a PNG file, by libavcodec's decoder.
Frame decodePng(std::vector<std::uint8_t> bytes) {
    AVCodecContext* decoder = avcodec_alloc_context3(avcodec_find_decoder(AV_CODEC_ID_PNG));
    decoder->thread_count = 1;
    REQUIRE(avcodec_open2(decoder, nullptr, nullptr) >= 0);
    AVPacket* packet = av_packet_alloc();
    AVFrame* picture = av_frame_alloc();
    packet->size = static_cast<int>(bytes.size());
    bytes.resize(bytes.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    packet->data = bytes.data();
    REQUIRE(avcodec_send_packet(decoder, packet) >= 0);
    REQUIRE(avcodec_receive_frame(decoder, picture) >= 0);
    REQUIRE(picture->format == AV_PIX_FMT_RGB24);

    Frame frame{picture->width, picture->height, {}};
    for (int row = 0; row < frame.height; ++row) {
        const std::uint8_t* line = picture->data[0] + row * picture->linesize[0];
        frame.rgb.insert(frame.rgb.end(), line, line + 3 * frame.width);
    }
    av_frame_free(&picture);
    av_packet_free(&packet);
    avcodec_free_context(&decoder);
    return frame;
}

/// Every pixel has its own colour, so that any exchange of pixels or channels shows.
Frame patternFrame(int width, int height) {
    Frame frame{width, height, {}};
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
            for (const int value : {10 + column, 100 + row, 200})
                frame.rgb.push_back(static_cast<std::uint8_t>(value));
    return frame;
}

}  // namespace

TEST_CASE("a PNG file has the frame's size and its pixels") {
    const TemporaryFolder folder;
    const fs::path path = folder.path / "picture.png";
    const Frame frame = patternFrame(37, 21);
    writePng(path.string(), frame);
    const auto bytes = bytesOf(path);
    REQUIRE(bytes.size() > 24);
    const std::vector<std::uint8_t> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    CHECK(std::equal(signature.begin(), signature.end(), bytes.begin()));
    CHECK(std::string(&bytes[12], &bytes[16]) == "IHDR");
    CHECK(int(bytes[19]) == 37);
    CHECK(int(bytes[23]) == 21);
    CHECK(same(decodePng(bytes), frame));
    CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
}

TEST_CASE("a PNG path that cannot be written is refused and leaves nothing") {
    const TemporaryFolder folder;
    const Frame frame = patternFrame(4, 4);
    CHECK_THROWS_AS(writePng((folder.path / "missing" / "a.png").string(), frame), InputError);
    CHECK_THROWS_AS(writePng("", frame), InputError);
    CHECK(folder.empty());
    CHECK_THROWS_AS(writePng(folder.path.string(), frame), InputError);
    CHECK(folder.empty());
    CHECK(!fs::exists(folder.path.string() + ".part"));
    CHECK_THROWS_AS(writePng((folder.path / "b.png").string(), Frame{4, 4, {1, 2, 3}}),
                    std::invalid_argument);
    CHECK(folder.empty());
}

TEST_CASE("a full disk is an error, and the picture of that name stays as it was") {
    const TemporaryFolder folder;
    const fs::path path = folder.path / "picture.png";
    std::ofstream(path) << "earlier";
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 10;  // bytes: writing beyond fails, as on a full disk
    setrlimit(RLIMIT_FSIZE, &small);
    bool failed = false;
    try {
        writePng(path.string(), patternFrame(37, 21));
    } catch (const InputError&) {
        failed = true;
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(failed);
    CHECK(fs::file_size(path) == 7u);
    CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
}
