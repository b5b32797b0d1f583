// Checks of chapter 08: the camera and the detail rule by hand, pictures against a ray caster.
#include <cstring>
#include <optional>

#include "08_sphere_rendering/sphere.h"
#include "common/error.h"
#include "common/offscreen_context.h"
#include "tests/checks/check_08_parts.cuh"
#include "tests/checks/check_08_pictures.cuh"
#include "tests/checks/check_08_shaders.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

const View08 front{cameraAt({0, 0, 20})};
constexpr int manySlices = 64;

/// Nets: half a pixel of outline, and highlights that a coarse net shows a little smaller or
/// larger.
constexpr Tolerance exact{1, 4}, faceted{2, 14}, coarse{2, 56};

/// One red ball aside of the middle, with all of its outline in the frame.
const std::vector<Ball08> oneBall{{{1.5f, 0.5f, 0}, 1.5f, red08}};

std::vector<Ball08> apart(std::vector<Ball08> balls) {
    std::vector<Ball08> kept;
    for (const Ball08& ball : balls) {
        const bool isFree = std::none_of(kept.begin(), kept.end(), [&](const Ball08& other) {
            return length(ball.position - other.position) < ball.radius + other.radius;
        });
        if (isFree) kept.push_back(ball);
    }
    return kept;
}

// ---- nets

/// How many pixels a sphere's list covers, drawn without camera or light into a frame of 200 x 200
/// pixels that goes from -1 to 1; after a smaller one, which must leave no trace.
int coveredByList(float radius) {
    SphereRenderer renderer(world08, 200, 200);
    renderer.style.world = false;
    renderer.draw({}, {}, {});
    for (const GLenum matrix : {GL_PROJECTION, GL_MODELVIEW}) {
        glMatrixMode(matrix);
        glLoadIdentity();
    }
    glColor3f(1, 1, 1);
    const Sphere sphere(64, 32);
    sphere.draw(0.5f * radius);
    sphere.draw(radius);
    const Frame frame = renderer.read();
    int count = 0;
    for (std::size_t k = 0; k < frame.rgb.size(); k += 3) count += !isBlack(&frame.rgb[k]);
    return count;
}

void sphereList(Report& report) {
    constexpr float discs = 3.14159265f * 100 * 100;  // pixels of a disc of radius 1
    for (const float radius : {0.2f, 0.4f}) {
        const float share = static_cast<float>(coveredByList(radius)) / (discs * radius * radius);
        if (std::abs(share - 1) > 0.04f)
            report.fail("pixels that a sphere of radius " + text(radius) + " covers",
                        text(share) + " times what they should be", "1 time");
        report.guess(
            {{"an empty picture", [&] { return share == 0; }},
             {"the diameter taken for the radius", [&] { return std::abs(share - 4) < 0.2f; }},
             {"half the radius, or a matrix that was not put back",
              [&] { return std::abs(share - 0.25f) < 0.02f; }}});
    }
    const std::vector<Ball08> ball{{{0, 0, 0}, 2, red08}};
    requirePicture(report, "a ball of 2 m at the origin", front, ball,
                   drawn(front, ball, BallShape::gluSpheres, manySlices), faceted);
}

void placed(Report& report) {
    const std::vector<Ball08> balls{{{-3, 1.5f, 1}, 0.6f, red08},
                                    {{2.5f, -1, -2}, 0.8f, green08},
                                    {{0.5f, 1, 3}, 0.4f, blue08}};
    const Frame got = drawn(front, balls, BallShape::gluSpheres, manySlices);
    const char* names[] = {"red", "green", "blue"};
    for (std::size_t k = 0; k < balls.size(); ++k) {
        const auto place =
            projectToPixel(front.camera, front.width, front.height, balls[k].position);
        const int x = static_cast<int>(place->x), y = static_cast<int>(place->y);
        const std::uint8_t* pixel = pixelOf(got, x, y);
        const std::size_t strongest =
            static_cast<std::size_t>(std::max_element(pixel, pixel + 3) - pixel);
        if (isBlack(pixel) || strongest != k)
            report.fail("the middle of the " + std::string(names[k]) + " ball: " + at(x, y),
                        colorText(pixel), names[k]);
    }
    if (report.failed()) {
        report.guess(pictureMistakes(front, balls, got, faceted));
        report.guess({{"all balls at the origin", [&] {
                           const std::uint8_t* middle = pixelOf(got, 160, 90);
                           return !isBlack(middle);
                       }}});
        report.picture([&] { return threeFrames(got, Expected(front, balls), faceted); });
    }
}

void nearHidesFar(Report& report) {
    const Ball08 nearer{{0.3f, 0.1f, 3}, 1, red08}, farther{{0, 0, -3}, 1.8f, blue08};
    for (const auto& balls : {std::vector{nearer, farther}, std::vector{farther, nearer}}) {
        const bool nearFirst = balls[0].radius == nearer.radius;
        const Frame got = drawn(front, balls, BallShape::gluSpheres, manySlices);
        requirePicture(report, nearFirst ? "two balls, near first" : "two balls, far first", front,
                       balls, got, faceted);
        if (!report.failed()) continue;
        const auto middle =
            projectToPixel(front.camera, front.width, front.height, nearer.position);
        const std::uint8_t* pixel =
            pixelOf(got, static_cast<int>(middle->x), static_cast<int>(middle->y));
        return report.guess({{"no depth test: what is drawn last covers all else",
                              [&] { return nearFirst && pixel[2] > pixel[0]; }}});
    }
}

void upright(Report& report) {
    const View08 view{cameraAt({4, 3, 19})};
    const std::vector<Ball08> balls{{{0, 2.5f, 0}, 1, red08}, {{3, -1, 0}, 0.7f, green08}};
    requirePicture(report, "a red ball above, a green one to the right", view, balls,
                   drawn(view, balls, BallShape::gluSpheres, manySlices), faceted);
}

void lightSide(Report& report) {
    const std::vector<Ball08> white{{{0, 0, 0}, 2.5f, {0.8f, 0.8f, 0.8f}}};
    requirePicture(report, "a white ball", front, white,
                   drawn(front, white, BallShape::gluSpheres, manySlices), faceted);
}

void netsBySize(Report& report) {
    const std::vector<Ball08> balls = apart(scattered08(24, report.seed));
    requirePicture(report, text(balls.size()) + " balls, as finely divided as they need", front,
                   balls, drawn(front, balls, BallShape::gluSpheres), coarse);
}

// ---- impostors

void exactImpostors(Report& report) {
    requirePicture(report, "one ball", front, oneBall, drawn(front, oneBall, BallShape::impostors),
                   exact);
    const View08 wide{cameraAt({6, 5, 7}, {0, 0, 0}, 70)};
    for (const View08& view : {front, wide}) {
        if (report.failed()) return;
        const std::vector<Ball08> balls = apart(scattered08(24, report.seed + 1));
        requirePicture(report, text(balls.size()) + " balls", view, balls,
                       drawn(view, balls, BallShape::impostors), exact);
    }
}

void impostorNormal(Report& report) {
    const std::vector<Ball08> white{{{-1, 0.5f, 2}, 2, {0.8f, 0.8f, 0.8f}}};
    requirePicture(report, "a white ball", front, white, drawn(front, white, BallShape::impostors),
                   exact);
}

/// Balls that cut each other: where they meet, surfaces decide, not centres.
void impostorDepth(Report& report) {
    const std::vector<Ball08> balls{{{0, 0, 0}, 2.5f, red08},
                                    {{1, 0.5f, -0.5f}, 2.4f, green08},
                                    {{-0.5f, 1.6f, 0.4f}, 1.4f, blue08}};
    requirePicture(report, "three balls that cut each other", front, balls,
                   drawn(front, balls, BallShape::impostors), exact);
    if (report.failed()) return;
    // The floor is at -5: of the ball's lower half nothing may be seen.
    const View08 view{cameraAt({0, 1, 14}, {0, -4, 0})};
    const std::vector<Ball08> sunk{{{0, -5, 0}, 1.5f, red08}};
    const Frame got = drawn(view, sunk, BallShape::impostors, 0, true);
    for (const float height : {-0.7f, 0.7f}) {
        const auto place = projectToPixel(view.camera, view.width, view.height,
                                          {0, -5 + height, height < 0 ? 1.2f : 0.0f});
        const std::uint8_t* pixel =
            pixelOf(got, static_cast<int>(place->x), static_cast<int>(place->y));
        const bool isRed = pixel[0] > 1.5 * std::max(pixel[1], pixel[2]);
        if (isRed != (height > 0))
            report.fail(std::string("a ball half sunk into the floor, seen ") +
                            (height > 0 ? "above" : "below") + " the floor",
                        colorText(pixel), height > 0 ? "red" : "the floor");
    }
}

void closeUp(Report& report) {
    // 480 pixels across, more than some drivers' largest point; and a centre outside the frame.
    const View08 near{cameraAt({0, 0, 3.2f}, {0, 0, 0}, 60), 480, 360};
    const std::vector<Ball08> balls{{{0, 0, 0}, 1.6f, red08}, {{-3.2f, 0.6f, 0}, 1.2f, green08}};
    for (const BallShape shape : {BallShape::impostors, BallShape::points})
        requirePicture(report,
                       std::string("two large balls as ") +
                           (shape == BallShape::points ? "points" : "squares"),
                       near, balls, drawn(near, balls, shape), exact);
}

void points(Report& report) {
    const std::vector<Ball08> balls = apart(scattered08(60, report.seed + 2));
    requirePicture(report, text(balls.size()) + " balls as points", front, balls,
                   drawn(front, balls, BallShape::points), exact);
}

/// What GLU spheres and impostors of the same balls differ by.
void samePicture(Report& report) {
    const std::vector<Ball08> balls = apart(scattered08(40, report.seed + 3));
    const Frame nets = drawn(front, balls, BallShape::gluSpheres);
    const Frame squares = drawn(front, balls, BallShape::impostors);
    std::size_t differing = 0, covered = 0;
    for (int y = 0; y < front.height; ++y)
        for (int x = 0; x < front.width; ++x) {
            const std::uint8_t *a = pixelOf(nets, x, y), *b = pixelOf(squares, x, y);
            if (isBlack(a) && isBlack(b)) continue;
            ++covered;
            for (int channel = 0; channel < 3; ++channel)
                if (std::abs(int{a[channel]} - int{b[channel]}) > 24) {
                    ++differing;
                    break;
                }
        }
    const double share =
        covered == 0 ? 1 : static_cast<double>(differing) / static_cast<double>(covered);
    if (share > 0.14)
        report.fail(
            "pixels of " + text(balls.size()) + " balls, as nets and as impostors, that differ",
            text(differing) + " of " + text(covered), "at most 14 of 100, on the outlines");
    char percent[16];
    std::snprintf(percent, sizeof percent, "%.1f", 100 * share);
    report.measured("nets and impostors differ in " + std::string(percent) +
                    " % of the balls' pixels, all on outlines");
}

}  // namespace

int main(int argc, char** argv) {
    const auto isList = [&](const char* word) { return std::strcmp(word, "--list") == 0; };
    std::optional<OffscreenContext> context;
    if (std::none_of(argv, argv + argc, isList)) {
        const int code = reportingErrors([&] { return context.emplace(), exitOk; });
        if (code != exitOk) return code;
    }
    return checkMain(
        argc, argv, "08",
        {{"camera.orbit", "The eye stands where yaw, pitch and distance say",
          "Every drag of the mouse goes through these three sines. A wrong sign turns the world "
          "the "
          "wrong way.",
          orbitByHand},
         {"camera.look_at", "In eye space the eye is at the origin and the target straight ahead",
          "Everything behind this matrix counts on it: the projection, the light, the impostors.",
          lookAtByHand},
         {"camera.perspective", "The near plane becomes -1, the far plane 1, the frame's edges 1",
          "What is twice as far must be half as large, and depths must keep their order.",
          perspectiveByHand},
         {"size.radius", "A ball's radius in pixels shrinks with its depth",
          "Detail that nobody can see costs as much as detail that everybody can.", radiusByHand},
         {"size.slices", "As few slices as keep the outline within half a pixel",
          "32 slices are too many for a ball of 10 pixels, and too few for one of 200.",
          slicesByTable},
         {"light.by_hand", "phong() gives the numbers worked out by hand",
          "Each GLSL function is run alone, for one pixel: so a slip is found before there is a "
          "picture.",
          phongByHand},
         {"impostor.hit_by_hand", "sphereHit() gives the numbers of the worked example",
          "The ray need not have length 1, and one that just misses must give a number, too.",
          hitByHand},
         {"impostor.normal_by_hand", "sphereNormal() points out of the ball and has length 1",
          "A normal of another length makes the light too strong or too weak.", normalByHand},
         {"impostor.depth_by_hand", "windowDepth() is 0 on the near plane and 1 on the far one",
          "The depth test compares your number with those that OpenGL computes for nets and floor.",
          depthByHand},
         {"net.radius", "A sphere has the radius it was asked for, not the diameter",
          "The list holds a sphere of radius 1. What scales it is the radius.", sphereList},
         {"net.place", "Every ball covers the pixel of its centre, in its own colour",
          "A matrix that is not put back moves every ball that comes after.", placed},
         {"depth.order", "The nearer ball hides the farther one, whichever is drawn first",
          "Bodies lie in cell order in memory. Who is in front changes with every step.",
          nearHidesFar},
         {"picture.upright", "Up in the world is up in the picture, and right is right",
          "Two mistakes that cancel in a symmetric scene do not cancel here.", upright},
         {"light.side", "Light comes from above on the left, and the highlight faces it",
          "Shading is what makes a disc look like a ball.", lightSide},
         {"picture.nets", "GLU spheres, divided by size, look as a ray caster sees them",
          "The oracle knows neither faces nor matrices. What both agree on is right.", netsBySize},
         {"impostor.hit", "An impostor is the ray caster's sphere, pixel by pixel",
          "The first point along the ray is what the eye sees.", exactImpostors},
         {"impostor.normal", "An impostor is lit as the ray caster lights it",
          "The normal is all that the light sees of a surface.", impostorNormal},
         {"impostor.depth", "Where balls cut each other or the floor, the nearer surface is seen",
          "A square is flat. Only the depth that you write makes it cut like a sphere.",
          impostorDepth},
         {"picture.close", "Balls larger than any point, and balls half outside, are whole",
          "Drivers cap the size of points, and drop those whose centre is outside.", closeUp},
         {"picture.points", "Points show the ray caster's spheres, too",
          "The fastest way must not be another picture.", points},
         {"picture.same", "Nets and impostors of the same balls are the same picture",
          "Otherwise one could not be exchanged for the other.", samePicture}});
}
