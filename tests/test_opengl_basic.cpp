// The picture is right: place, size, colour, order and orientation of balls.
#include "08_sphere_rendering/opengl_program.h"
#include "common/error.h"
#include "common/offscreen_context.h"
#include "tests/pictures.h"

#include <stdexcept>

using namespace ballpit;

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

TEST_CASE("a shader that the driver refuses is named with the line that it means") {
    const OffscreenContext context;
    const std::string good = "void main() { gl_Position = vec4(0.0); }";
    const std::string bad = "#version 120\nvoid main() {\n    gl_FragColor = no_such_name;\n}\n";
    std::string words;
    try {
        const OpenGLProgram program(good, bad);
    } catch (const std::runtime_error& error) {
        words = error.what();
    }
    CHECK(words.starts_with("the driver refused a shader: "));
    CHECK(words.ends_with("; the line is:     gl_FragColor = no_such_name;"));
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
