// Where the camera of a film stands.
#include "common/camera.h"
#include "common/shot.h"
#include "tests/catch.h"

using namespace ballpit;

namespace {

constexpr Bounds world{{-2, 0, -1}, {2, 3, 1}};

Vec3 armOf(const Camera& camera) { return camera.eye - camera.target; }

bool near(Vec3 a, Vec3 b) { return length(a - b) < 1e-3f; }

}  // namespace

TEST_CASE("a shot of which nothing is said is the usual view of the world") {
    const Camera camera = cameraOf({}, world, 3.0f), usual = frameWorld(world);
    CHECK(camera.eye == usual.eye);
    CHECK(camera.target == usual.target);
}

TEST_CASE("yaw 0 looks from the front, 90 from the right; pitch 90 from above") {
    const Vec3 front = armOf(cameraOf({.yaw = 0.0f, .pitch = 0.0f}, world, 0));
    CHECK(near(front / length(front), {0, 0, 1}));
    const Vec3 right = armOf(cameraOf({.yaw = 90.0f, .pitch = 0.0f}, world, 0));
    CHECK(near(right / length(right), {1, 0, 0}));
    const Vec3 above = armOf(cameraOf({.yaw = 0.0f, .pitch = 90.0f}, world, 0));
    CHECK(above.y / length(above) > 0.99999f);
}

TEST_CASE("the angle that is not given stays as usual") {
    const Vec3 usual = armOf(frameWorld(world));
    const Vec3 turned = armOf(cameraOf({.yaw = 10.0f}, world, 0));
    CHECK(turned.y / length(turned) == Approx(usual.y / length(usual)).epsilon(1e-4));
    const Vec3 raised = armOf(cameraOf({.pitch = 50.0f}, world, 0));
    CHECK(raised.x / raised.z == Approx(usual.x / usual.z).epsilon(1e-4));
}

TEST_CASE("the whole world is in the frame, from wherever it is seen") {
    for (const float yaw : {-170.0f, -45.0f, 0.0f, 60.0f, 90.0f})
        for (const float pitch : {-20.0f, 0.0f, 40.0f, 90.0f})
            for (int k = 0; k < 8; ++k) {
                CAPTURE(yaw, pitch, k);
                const Vec3 corner{k & 1 ? 2.0f : -2.0f, k & 2 ? 3.0f : 0.0f, k & 4 ? 1.0f : -1.0f};
                const Camera camera = cameraOf({.yaw = yaw, .pitch = pitch}, world, 0);
                CHECK(projectToPixel(camera, 1600, 900, corner));
            }
}

TEST_CASE("zoom 2 is half as far away from the same target") {
    const Camera camera = cameraOf({.zoom = 2.0f}, world, 0), usual = frameWorld(world);
    CHECK(near(camera.target, usual.target));
    CHECK(near(2.0f * armOf(camera), armOf(usual)));
}

TEST_CASE("an orbit walks to the right, keeps its height, and is back after a full turn") {
    const Shot shot{.yaw = 0.0f, .pitch = 20.0f, .orbit = 30.0f};
    const Camera start = cameraOf(shot, world, 0), later = cameraOf(shot, world, 3),
                 back = cameraOf(shot, world, 12);
    CHECK(armOf(later).x == Approx(armOf(start).z).epsilon(1e-4));
    CHECK(later.eye.y == start.eye.y);
    CHECK(near(back.eye, start.eye));
}
