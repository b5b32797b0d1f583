// The picture is right: place, size, colour, order and orientation of balls, and PNG files.
#include "08_sphere_rendering/sphere_renderer.h"
#include "common/error.h"
#include "common/offscreen_context.h"
#include "tests/catch.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <stdexcept>

extern "C" {
#include <libavcodec/avcodec.h>
}

using namespace ballpit;

namespace {

namespace fs = std::filesystem;

constexpr Bounds world{{-5.0f, -5.0f, -5.0f}, {5.0f, 5.0f, 5.0f}};
constexpr Vec3 red{1.0f, 0.1f, 0.1f}, green{0.1f, 1.0f, 0.1f}, blue{0.1f, 0.1f, 1.0f};
constexpr Vec3 magenta{1.0f, 0.1f, 1.0f};

struct Ball {
    Vec3 position;
    float radius;
    Vec3 color;
};

/// Draws on a fresh renderer, so that no picture depends on the one before.
Frame render(const Camera& camera, int width, int height, const std::vector<Ball>& balls) {
    SphereRenderer renderer(world, width, height);
    renderer.camera = camera;
    std::vector<Vec3> positions, colors;
    std::vector<float> radii;
    for (const Ball& ball : balls) {
        positions.push_back(ball.position);
        radii.push_back(ball.radius);
        colors.push_back(ball.color);
    }
    renderer.draw(positions, radii, colors);
    return renderer.read();
}

/// Looks at the world's centre from the front: x to the right, y up.
Camera frontCamera() {
    Camera camera;
    camera.eye = {0.0f, 0.0f, 20.0f};
    return camera;
}

/// Compared here and not in a CHECK, which would print all bytes.
bool same(const Frame& a, const Frame& b) {
    return a.width == b.width && a.height == b.height && a.rgb == b.rgb;
}

std::size_t byteIndex(const Frame& frame, int column, int row) {
    return 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width) +
                static_cast<std::size_t>(column));
}

/// A pixel's colour in [0, 1].
Vec3 colorAt(const Frame& frame, PixelPosition place) {
    const auto* pixel =
        &frame.rgb[byteIndex(frame, static_cast<int>(place.x), static_cast<int>(place.y))];
    return Vec3{float(pixel[0]), float(pixel[1]), float(pixel[2])} / 255.0f;
}

/// The pixel's colour where a point of the world falls, which must be inside the frame.
Vec3 colorWhere(const Frame& frame, const Camera& camera, Vec3 point) {
    const auto place = projectToPixel(camera, frame.width, frame.height, point);
    REQUIRE(place.has_value());
    return colorAt(frame, *place);
}

/// 'r', 'g' or 'b' if that channel is clearly above both others, else '-'.
char hue(Vec3 c) {
    if (c.x > 1.5f * std::max(c.y, c.z)) return 'r';
    if (c.y > 1.5f * std::max(c.x, c.z)) return 'g';
    if (c.z > 1.5f * std::max(c.x, c.y)) return 'b';
    return '-';
}

struct Extent {
    float left = 1e9f, right = -1e9f, top = 1e9f, bottom = -1e9f;

    void include(float x, float y) {
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
    }
};

/// The extent of a scene's magenta balls, to the pixels that they cover by about a half.
Extent ballExtent(const Camera& camera, int width, int height, const std::vector<Ball>& balls) {
    const Frame frame = render(camera, width, height, balls);
    const Frame empty = render(camera, width, height, {});
    Extent extent;
    for (int row = 0; row < frame.height; ++row)
        for (int column = 0; column < frame.width; ++column) {
            const auto x = static_cast<float>(column), y = static_cast<float>(row);
            const Vec3 color = colorAt(frame, {x, y});
            // Where the axes meet, they too are magenta.
            if (color == colorAt(empty, {x, y})) continue;
            if (std::min(color.x, color.z) < 1.3f * color.y) continue;
            extent.include(x, y);
            extent.include(x + 1.0f, y + 1.0f);
        }
    return extent;
}

Vec3 unit(Vec3 a) { return a / length(a); }

/// Where sight just touches the ball is a circle: its extent in the picture.
Extent silhouetteExtent(const Camera& camera, int width, int height, const Ball& ball) {
    const Vec3 toEye = camera.eye - ball.position;
    const float ratio = ball.radius * ball.radius / lengthSquared(toEye);
    const Vec3 center = ball.position + ratio * toEye;
    const float radius = ball.radius * std::sqrt(1.0f - ratio);
    const Vec3 a = unit(cross(toEye, {0.3f, 1.0f, 0.2f})), b = unit(cross(toEye, a));
    Extent extent;
    for (int degree = 0; degree < 360; ++degree) {
        const float angle = static_cast<float>(degree) * std::numbers::pi_v<float> / 180.0f;
        const Vec3 point = center + radius * (std::cos(angle) * a + std::sin(angle) * b);
        const auto pixel = projectToPixel(camera, width, height, point);
        REQUIRE(pixel.has_value());
        extent.include(pixel->x, pixel->y);
    }
    return extent;
}

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

TEST_CASE("a point of the world falls on the pixel that perspective says") {
    Camera camera = frontCamera();
    camera.verticalFieldOfView = 90.0f;  // half the height is as far aside as the point is away
    const auto center = projectToPixel(camera, 200, 100, {0.0f, 0.0f, 0.0f});
    REQUIRE(center.has_value());
    CHECK(center->x == Approx(100.0));
    CHECK(center->y == Approx(50.0));
    const auto aside = projectToPixel(camera, 200, 100, {10.0f, 5.0f, 0.0f});
    REQUIRE(aside.has_value());
    CHECK(aside->x == Approx(125.0));
    CHECK(aside->y == Approx(37.5));
    CHECK(!projectToPixel(camera, 200, 100, {0.0f, 0.0f, 21.0f}).has_value());
    CHECK(!projectToPixel(camera, 200, 100, {0.0f, 20.5f, 0.0f}).has_value());
}

TEST_CASE("frameWorld shows the whole box and leaves little room around it") {
    for (const Bounds box : {Bounds{{-20, 0, -20}, {20, 40, 20}}, Bounds{{-1, -1, -1}, {1, 1, 1}},
                             Bounds{{100, 5, 0}, {300, 6, 10}}, Bounds{{0, 0, 0}, {1, 50, 1}}}) {
        CAPTURE(box.upper.x, box.upper.y, box.upper.z);
        const Camera camera = frameWorld(box);
        Extent extent;
        for (const float x : {box.lower.x, box.upper.x})
            for (const float y : {box.lower.y, box.upper.y})
                for (const float z : {box.lower.z, box.upper.z}) {
                    const auto pixel = projectToPixel(camera, 1600, 900, {x, y, z});
                    REQUIRE(pixel.has_value());
                    extent.include(pixel->x, pixel->y);
                }
        const float across = (extent.right - extent.left) / 1600.0f;
        const float along = (extent.bottom - extent.top) / 900.0f;
        CHECK(std::max(across, along) > 0.9f);
    }
}

TEST_CASE("an offscreen frame has the size that was asked for") {
    const OffscreenContext context;
    CHECK(!context.description().empty());
    const Frame frame = render(frontCamera(), 321, 123, {});
    CHECK(frame.width == 321);
    CHECK(frame.height == 123);
    CHECK(frame.rgb.size() == 3u * 321u * 123u);
}

TEST_CASE("OpenGL contexts can be made one after the other") {
    for (int i = 0; i < 3; ++i) {
        const OffscreenContext context;
        CHECK(render(frontCamera(), 16, 16, {}).rgb.size() == 3u * 16u * 16u);
    }
}

TEST_CASE("an empty scene shows background, floor and the three axes") {
    const OffscreenContext context;
    const Camera camera = frameWorld(world);
    const Frame frame = render(camera, 640, 360, {});
    const float reach = 0.15f * 10.0f * 0.6f;
    CHECK(hue(colorWhere(frame, camera, world.lower + Vec3{reach, 0, 0})) == 'r');
    CHECK(hue(colorWhere(frame, camera, world.lower + Vec3{0, reach, 0})) == 'g');
    CHECK(hue(colorWhere(frame, camera, world.lower + Vec3{0, 0, reach})) == 'b');
    const auto [lowest, highest] = std::ranges::minmax(frame.rgb);
    CHECK(int(lowest) < int(highest));
}

TEST_CASE("a ball appears where projectToPixel says, in its own colour") {
    const OffscreenContext context;
    const Camera camera = frameWorld(world);
    const std::vector<Ball> balls{{{-3.0f, 2.0f, 1.0f}, 0.5f, red},
                                  {{3.0f, -1.0f, -2.0f}, 0.5f, green},
                                  {{0.0f, 4.0f, 3.0f}, 0.5f, blue}};
    const Frame empty = render(camera, 640, 360, {}), frame = render(camera, 640, 360, balls);
    for (const Ball& ball : balls) CHECK(hue(colorWhere(empty, camera, ball.position)) == '-');
    CHECK(hue(colorWhere(frame, camera, balls[0].position)) == 'r');
    CHECK(hue(colorWhere(frame, camera, balls[1].position)) == 'g');
    CHECK(hue(colorWhere(frame, camera, balls[2].position)) == 'b');
}

TEST_CASE("the nearer of two balls hides the farther, whichever is drawn first") {
    const OffscreenContext context;
    const Camera camera = frontCamera();
    const Ball nearBall{{0.2f, 0.1f, 3.0f}, 1.0f, red}, farBall{{0.0f, 0.0f, -3.0f}, 1.5f, blue};
    const Frame frame = render(camera, 320, 180, {nearBall, farBall});
    CHECK(hue(colorWhere(frame, camera, nearBall.position)) == 'r');
    CHECK(hue(colorWhere(frame, camera, farBall.position + Vec3{-1.4f, 0, 0})) == 'b');
    CHECK(same(frame, render(camera, 320, 180, {farBall, nearBall})));
}

TEST_CASE("each pixel shows the nearest surface, not the ball with the nearest centre") {
    const OffscreenContext context;
    const Camera camera = frontCamera();
    const Ball large{{0.0f, 0.0f, 0.0f}, 3.0f, red}, inside{{0.0f, 0.0f, 1.0f}, 1.0f, blue};
    const Ball pokesOut{{0.0f, 2.0f, 2.0f}, 1.0f, green};
    for (const auto& balls :
         {std::vector{large, inside, pokesOut}, std::vector{pokesOut, inside, large}}) {
        const Frame frame = render(camera, 320, 180, balls);
        CHECK(hue(colorWhere(frame, camera, inside.position)) == 'r');
        CHECK(hue(colorWhere(frame, camera, pokesOut.position)) == 'g');
    }
}

TEST_CASE("up in the world is up in the picture, and right is right") {
    const OffscreenContext context;
    const Ball above{{0.0f, 3.0f, 0.0f}, 1.0f, magenta}, below{{0.0f, -3.0f, 0.0f}, 1.0f, red};
    const Extent extent = ballExtent(frontCamera(), 320, 180, {above, below});
    CHECK(extent.bottom < 90.0f);
    CHECK(extent.top > 0.0f);
    const Ball right{{3.0f, 0.0f, 0.0f}, 1.0f, magenta};
    CHECK(ballExtent(frontCamera(), 320, 180, {right}).left > 160.0f);
}

TEST_CASE("a ball's silhouette has the size that perspective gives it") {
    const OffscreenContext context;
    Camera camera = frontCamera();
    camera.eye = {0.0f, 0.0f, 10.0f};
    camera.verticalFieldOfView = 90.0f;
    // In the middle; towards a corner, 55 degrees off the axis; tiny; wider than 255 pixels, which
    // is the largest point that some drivers draw.
    for (const Ball& ball :
         {Ball{{0.0f, 0.0f, 0.0f}, 2.0f, magenta}, Ball{{7.5f, 3.5f, 4.0f}, 1.0f, magenta},
          Ball{{-4.0f, 3.0f, -5.0f}, 0.3f, magenta}, Ball{{0.5f, 0.5f, 4.0f}, 3.8f, magenta}}) {
        CAPTURE(ball.position.x, ball.position.y, ball.position.z, ball.radius);
        const Extent expected = silhouetteExtent(camera, 640, 360, ball);
        const Extent measured = ballExtent(camera, 640, 360, {ball});
        CHECK(measured.left == Approx(expected.left).margin(1.5));
        CHECK(measured.right == Approx(expected.right).margin(1.5));
        CHECK(measured.top == Approx(expected.top).margin(1.5));
        CHECK(measured.bottom == Approx(expected.bottom).margin(1.5));
    }
}

TEST_CASE("a ball is drawn as long as any part of it is inside the frame") {
    const OffscreenContext context;
    const Camera camera = frontCamera();
    const Ball high{{0.0f, 9.0f, 0.0f}, 4.0f, magenta};
    CHECK(!projectToPixel(camera, 320, 180, high.position).has_value());
    const Extent extent = ballExtent(camera, 320, 180, {high});
    CHECK(extent.top == 0.0f);
    CHECK(extent.bottom > 5.0f);
}

TEST_CASE("a ball behind the eye, or around it, is not seen") {
    const OffscreenContext context;
    const Camera camera = frontCamera();
    const Frame empty = render(camera, 320, 180, {});
    for (const float z : {19.0f, 21.0f, 25.0f}) {
        CAPTURE(z);
        CHECK(same(render(camera, 320, 180, {{{0.0f, 0.0f, z}, 4.0f, magenta}}), empty));
    }
}

TEST_CASE("a ball beside the eye is seen where it reaches before it") {
    const OffscreenContext context;
    const Camera camera = frontCamera();
    const Extent extent = ballExtent(camera, 320, 180, {{{3.0f, 0.0f, 18.0f}, 2.5f, magenta}});
    // Its centre is atan(3 / 2) off the axis, its left edge asin(2.5 / sqrt(13)) less.
    CHECK(extent.left == Approx(222.8).margin(1.5));
    CHECK(extent.right == 320.0f);
}

TEST_CASE("a ball shades the floor below it") {
    const OffscreenContext context;
    const Camera camera = frameWorld(world);
    const Vec3 below{1.0f, world.lower.y, 1.0f};
    const Frame empty = render(camera, 640, 360, {});
    const Frame frame = render(camera, 640, 360, {{below + Vec3{0, 3, 0}, 0.5f, green}});
    CHECK(colorWhere(frame, camera, below).x < 0.9f * colorWhere(empty, camera, below).x);
    const Vec3 elsewhere{-3.3f, world.lower.y, 2.2f};
    CHECK(colorWhere(frame, camera, elsewhere) == colorWhere(empty, camera, elsewhere));
}

TEST_CASE("reading a frame twice, or drawing it twice, gives the same picture") {
    const OffscreenContext context;
    SphereRenderer renderer(world, 320, 180);
    const std::vector<Vec3> positions{{1, 2, 3}, {-2, 0, 1}}, colors{red, blue};
    const std::vector<float> radii{1.0f, 2.0f};
    renderer.draw(positions, radii, colors);
    const Frame first = renderer.read();
    CHECK(same(first, renderer.read()));
    renderer.draw(positions, radii, colors);
    CHECK(same(first, renderer.read()));
}

TEST_CASE("a ball that is not finite is left out, and the others are drawn as ever") {
    const OffscreenContext context;
    const Camera camera = frontCamera();
    const Ball farthest{{0.0f, 0.0f, -3.0f}, 1.5f, blue}, middle{{0.5f, 0.0f, 0.0f}, 1.0f, red};
    const Ball nearest{{0.2f, 0.9f, 3.0f}, 1.0f, magenta};
    const Ball lost{{NAN, 0.0f, 0.0f}, 1.0f, green}, gone{{0.0f, 0.0f, INFINITY}, 1.0f, green};
    // In this order a lost ball would also keep the others from being sorted.
    const Frame frame = render(camera, 320, 180, {farthest, nearest, lost, gone, middle});
    CHECK(same(frame, render(camera, 320, 180, {farthest, middle, nearest})));
}

TEST_CASE("the renderer refuses sizes that cannot be") {
    const OffscreenContext context;
    CHECK_THROWS_AS(SphereRenderer(world, 0, 100), InputError);
    CHECK_THROWS_AS(SphereRenderer(world, 100, 1 << 24), InputError);
    SphereRenderer renderer(world, 16, 16);
    const std::vector<Vec3> two(2);
    const std::vector<float> one(1);
    CHECK_THROWS_AS(renderer.draw(two, one, two), std::invalid_argument);
}

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
