// The camera: where points of the world fall, views of whole boxes, orbits.
#include "08_sphere_rendering/orbit_camera.h"
#include "08_sphere_rendering/view_matrices.h"
#include "tests/pictures.h"

using namespace ballpit;

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

TEST_CASE("an orbit stands where its camera stands, and moves as the hand does") {
    const Camera camera = frameWorld({{-20, 0, -20}, {20, 40, 20}});
    OrbitCamera orbit = orbitOf(camera);
    CHECK(length(orbit.camera().eye - camera.eye) < 1e-3f);
    CHECK(orbit.camera().target == camera.target);
    CHECK(orbit.verticalFieldOfView == camera.verticalFieldOfView);

    const float distance = orbit.distance;
    orbit.zoom(0.5f);
    CHECK(length(orbit.eye() - orbit.target) == Approx(distance / 2));
    orbit.orbit(0.0f, 500.0f);
    CHECK(orbit.pitch == 89.0f);
    orbit.orbit(0.0f, -500.0f);
    CHECK(orbit.pitch == -89.0f);
}

TEST_CASE("an orbit to the right brings what was on the right side to the front") {
    OrbitCamera orbit{.distance = 10.0f};
    const auto across = [&](Vec3 point) {
        return projectToPixel(orbit.camera(), 200, 100, point)->x;
    };
    CHECK(across({1, 0, 0}) > 100.0f);
    orbit.orbit(90.0f, 0.0f);
    CHECK(across({1, 0, 0}) == Approx(100.0f));
    CHECK(across({0, 0, 1}) < 100.0f);  // what was in front is on the left
}

TEST_CASE("panning moves the picture, not the angle") {
    OrbitCamera orbit{.yaw = 30.0f, .pitch = 20.0f, .distance = 10.0f};
    const Vec3 before = orbit.eye();
    orbit.pan(2.0f, 1.0f);
    CHECK(length(orbit.eye() - before) == Approx(std::sqrt(5.0f)));
    const auto seen = projectToPixel(orbit.camera(), 200, 100, Vec3{});
    REQUIRE(seen.has_value());
    CHECK(seen->x < 100.0f);
    CHECK(seen->y > 50.0f);
}

TEST_CASE("the two matrices put a point where projectToPixel says") {
    const Camera camera = frameWorld({{-20, 0, -20}, {20, 40, 20}});
    const Matrix4 view = lookAt(camera), projection = perspective(camera, 2.0f, 1.0f, 200.0f);
    const auto times = [](const Matrix4& m, Vec4 p) {
        const auto row = [&](std::size_t r) {
            return m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r] * p.w;
        };
        return Vec4{row(0), row(1), row(2), row(3)};
    };
    for (const Vec3 point : {Vec3{0, 20, 0}, Vec3{-10, 3, 15}, Vec3{12, 30, -9}}) {
        const Vec4 clip = times(projection, times(view, withW(point, 1.0f)));
        const auto pixel = projectToPixel(camera, 800, 400, point);
        REQUIRE(pixel.has_value());
        CHECK(pixel->x == Approx(400.0f + 400.0f * clip.x / clip.w));
        CHECK(pixel->y == Approx(200.0f - 200.0f * clip.y / clip.w));
    }
}
