// Squares, points and nets show the same balls; points from a buffer that others fill; styles.
#include "common/error.h"
#include "common/offscreen_context.h"
#include "common/random.h"
#include "tests/pictures.h"

#include <GL/glew.h>

#include <cstdlib>
#include <stdexcept>

using namespace ballpit;

namespace {

std::vector<Ball> manyBalls(std::size_t count, float smallest, float largest) {
    Random random(7);
    std::vector<Ball> balls;
    for (std::size_t k = 0; k < count; ++k)
        balls.push_back({random.uniformIn({{-4, -4.5f, -4}, {4, 4, 4}}),
                         random.uniform(smallest, largest),
                         random.uniformIn({{0.2f, 0.2f, 0.2f}, {1, 1, 1}})});
    return balls;
}

/// The share of pixels that differ by more than `levels` of 255 in a channel.
double differing(const Frame& a, const Frame& b, int levels) {
    REQUIRE(a.rgb.size() == b.rgb.size());
    std::size_t count = 0;
    for (std::size_t k = 0; k < a.rgb.size(); k += 3)
        for (std::size_t channel = 0; channel < 3; ++channel)
            if (std::abs(int(a.rgb[k + channel]) - int(b.rgb[k + channel])) > levels) {
                ++count;
                break;
            }
    return double(count) / double(a.rgb.size() / 3);
}

Frame shown(const std::vector<Ball>& balls, BallShape shape) {
    return render(frameWorld(world), 640, 360, balls, {.shape = shape});
}

/// A renderer's balls in its own buffer, as a kernel would write them there.
struct InBuffer {
    std::vector<Vec4> places;
    std::vector<Vec3> colors;
    float largest = 0.0f;

    explicit InBuffer(const std::vector<Ball>& balls) {
        for (const Ball& ball : balls) {
            places.push_back(withW(ball.position, ball.radius));
            colors.push_back(ball.color);
            largest = std::max(largest, ball.radius);
        }
    }

    void fill(SphereRenderer& renderer) const {
        glBindBuffer(GL_ARRAY_BUFFER, renderer.positionBuffer(places.size()));
        glBufferSubData(GL_ARRAY_BUFFER, 0, GLsizeiptr(places.size() * sizeof(Vec4)),
                        places.data());
        glBindBuffer(GL_ARRAY_BUFFER, 0);
        renderer.setColors(colors);
    }
};

}  // namespace

TEST_CASE("points and squares show the same balls, but for soft edges") {
    const OffscreenContext context;
    const std::vector<Ball> balls = manyBalls(300, 0.1f, 0.6f);
    const Frame squares = shown(balls, BallShape::impostors);
    const Frame points = shown(balls, BallShape::points);
    CHECK(differing(squares, points, 8) < 0.06);    // outlines
    CHECK(differing(squares, points, 128) < 0.01);  // where one is there and the other is not
    CHECK(differing(squares, shown({}, BallShape::points), 8) > 0.2);
}

TEST_CASE("nets of faces show the same balls, but for half a pixel of outline") {
    const OffscreenContext context;
    const std::vector<Ball> balls = manyBalls(40, 0.3f, 0.9f);
    const Frame squares = shown(balls, BallShape::impostors);
    CHECK(differing(squares, shown(balls, BallShape::gluSpheres), 24) < 0.015);
    const Frame coarse =
        render(frameWorld(world), 640, 360, balls, {.shape = BallShape::gluSpheres, .slices = 6});
    CHECK(differing(squares, coarse, 24) > 0.02);
}

TEST_CASE("a ball too large for a point, or half outside the frame, is whole among points") {
    const OffscreenContext context;
    Camera camera = frontCamera();
    camera.eye = {0.0f, 0.0f, 6.0f};
    const std::vector<Ball> balls{
        {{0, 0, 0}, 1.6f, red}, {{3.7f, 0.5f, 0}, 0.9f, green}, {{-3.6f, -1.9f, 0}, 0.5f, blue}};
    const Frame squares = render(camera, 640, 360, balls, {.shape = BallShape::impostors});
    const Frame points = render(camera, 640, 360, balls, {.shape = BallShape::points});
    CHECK(differing(squares, points, 128) < 0.005);
}

TEST_CASE("a ball smaller than a pixel is seen among points") {
    const OffscreenContext context;
    const Camera camera = frontCamera();
    for (int k = 0; k < 20; ++k) {
        const Ball tiny{{0.013f * float(k), 0.007f * float(k), 0}, 0.002f, magenta};
        const Frame frame = render(camera, 320, 180, {tiny}, {.shape = BallShape::points});
        CHECK(!same(frame, render(camera, 320, 180, {}, {.shape = BallShape::points})));
    }
}

TEST_CASE("many balls become points by themselves") {
    const OffscreenContext context;
    const std::vector<Ball> many = manyBalls(20'001, 0.02f, 0.05f);
    CHECK(same(shown(many, BallShape::automatic), shown(many, BallShape::points)));
    const std::vector<Ball> few(many.begin(), many.begin() + 2000);
    CHECK(same(shown(few, BallShape::automatic), shown(few, BallShape::impostors)));
}

TEST_CASE("balls that others write into the buffer are drawn as if they were given") {
    const OffscreenContext context;
    for (const float largest : {0.3f, 4.0f}) {  // as points; and too large for them
        CAPTURE(largest);
        const std::vector<Ball> balls = manyBalls(200, 0.5f * largest, largest);
        const InBuffer inBuffer(balls);
        SphereRenderer renderer(world, 640, 360);
        renderer.style.shape = BallShape::points;
        inBuffer.fill(renderer);
        renderer.drawFromBuffer(inBuffer.largest);
        const Frame frame = renderer.read();
        CHECK(same(frame, shown(balls, BallShape::points)));
        renderer.drawFromBuffer(inBuffer.largest);
        CHECK(same(frame, renderer.read()));
    }
}

TEST_CASE("balls in the buffer need a colour each, and lost balls are left out there, too") {
    const OffscreenContext context;
    const std::vector<Ball> good = manyBalls(50, 0.2f, 0.4f);
    std::vector<Ball> bad = good;
    bad.push_back({{NAN, 0, 0}, 1.0f, red});
    bad.push_back({{0, INFINITY, 0}, 1.0f, red});
    bad.push_back({{0, 0, 0}, 0.0f, red});
    SphereRenderer renderer(world, 640, 360);
    InBuffer(bad).fill(renderer);
    renderer.drawFromBuffer(0.4f);
    CHECK(same(renderer.read(), shown(good, BallShape::points)));
    renderer.setColors({});
    CHECK_THROWS_AS(renderer.drawFromBuffer(0.4f), std::invalid_argument);
}

TEST_CASE("colours that change are seen with the next picture of points") {
    const OffscreenContext context;
    SphereRenderer renderer(world, 320, 180);
    renderer.camera = frontCamera();
    renderer.style.shape = BallShape::points;
    const std::vector<Vec3> place{{0, 0, 0}};
    const std::vector<float> radius{1.0f};
    for (const auto& [color, expected] : {std::pair(red, 'r'), std::pair(blue, 'b')}) {
        renderer.draw(place, radius, std::vector<Vec3>{color});
        CHECK(hue(colorWhere(renderer.read(), renderer.camera, place[0])) == expected);
    }
}

TEST_CASE("thousands of balls above one place shade the floor no more than the darkest of them") {
    const OffscreenContext context;
    const Camera camera = frameWorld(world);
    const Vec3 spot{0.3f, world.lower.y, 0.4f}, beside = spot + Vec3{0.32f, 0, 0};
    for (const BallShape shape : {BallShape::impostors, BallShape::points}) {
        const auto brightness = [&](std::size_t count) {
            const std::vector<Ball> pile(count, Ball{spot + Vec3{0, 0.6f, 0}, 0.3f, red});
            return colorWhere(render(camera, 640, 360, pile, {.shape = shape}), camera, beside).x;
        };
        const float single = brightness(1);
        CHECK(single < brightness(0) - 0.02f);
        CHECK(brightness(2000) == single);
    }
}

TEST_CASE("a crowd in which only some balls cast shade still shades the floor") {
    const OffscreenContext context;
    const Camera camera = frameWorld(world);
    const Vec3 spot{0.3f, world.lower.y, 0.4f}, beside = spot + Vec3{0.32f, 0, 0};
    const auto brightness = [&](std::size_t count) {
        const std::vector<Ball> pile(count, Ball{spot + Vec3{0, 0.6f, 0}, 0.3f, red});
        const DrawStyle style{.shape = BallShape::points};
        return colorWhere(render(camera, 320, 180, pile, style), camera, beside).x;
    };
    const float single = brightness(1);
    CHECK(single < brightness(0) - 0.02f);
    for (const std::size_t count : {100'001u, 250'000u}) CHECK(brightness(count) == single);
}

TEST_CASE("points shade the floor as squares do") {
    const OffscreenContext context;
    const Camera camera = frameWorld(world);
    const std::vector<Ball> balls{{{1, -2, 1}, 0.5f, green}};
    for (const Vec3 spot : {Vec3{1, -5, 1}, Vec3{1.4f, -5, 1.3f}}) {
        const auto shade = [&](BallShape shape) {
            return colorWhere(render(camera, 640, 360, balls, {.shape = shape}), camera, spot).x;
        };
        CHECK(shade(BallShape::points) == Approx(shade(BallShape::impostors)).margin(0.01));
    }
}

TEST_CASE("a wireframe leaves most of a ball's pixels to what is behind it") {
    const OffscreenContext context;
    const std::vector<Ball> ball{{{0, 0, 0}, 3.0f, red}};
    const auto redPixels = [&](bool wireframe) {
        const Frame frame = render(frontCamera(), 640, 360, ball,
                                   {.wireframe = wireframe, .shape = BallShape::impostors});
        int count = 0;
        for (std::size_t k = 0; k < frame.rgb.size(); k += 3)
            count += frame.rgb[k] > 2 * std::max(frame.rgb[k + 1], frame.rgb[k + 2]);
        return count;
    };
    const int lines = redPixels(true), whole = redPixels(false);
    CHECK(lines > 200);
    CHECK(lines < whole / 2);
}

TEST_CASE("the floor's grid and the whole world can be hidden") {
    const OffscreenContext context;
    const Camera camera = frameWorld(world);
    const Frame plain = render(camera, 320, 180, {}, {.floorGrid = false});
    CHECK(!same(plain, render(camera, 320, 180, {})));
    const Frame black = render(camera, 320, 180, {}, {.world = false});
    CHECK(std::ranges::all_of(black.rgb, [](int byte) { return byte == 0; }));
}

TEST_CASE("after resize, frames have the new size and show the same") {
    const OffscreenContext context;
    SphereRenderer renderer(world, 640, 360);
    const std::vector<Vec3> place{{1, 2, 3}}, color{red};
    const std::vector<float> radius{1.0f};
    renderer.resize(320, 180);
    CHECK(renderer.width() == 320);
    renderer.draw(place, radius, color);
    CHECK(same(renderer.read(), render(renderer.camera, 320, 180, {{place[0], 1.0f, red}})));
    CHECK_THROWS_AS(renderer.resize(1 << 24, 180), InputError);
    CHECK(renderer.width() == 320);
    CHECK(same(renderer.read(), render(renderer.camera, 320, 180, {{place[0], 1.0f, red}})));
}

TEST_CASE("what is drawn can be read from the framebuffer's name") {
    const OffscreenContext context;
    SphereRenderer renderer(world, 64, 64);
    renderer.camera = frontCamera();
    renderer.draw(std::vector<Vec3>{{0, 0, 0}}, std::vector<float>{2.0f}, std::vector<Vec3>{red});
    glBindFramebuffer(GL_READ_FRAMEBUFFER, renderer.framebuffer());
    unsigned char pixel[4] = {};
    glReadPixels(32, 32, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    CHECK(int(pixel[0]) > 2 * int(pixel[1]));
}
