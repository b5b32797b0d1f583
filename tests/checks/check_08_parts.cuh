// Checks of chapter 08's small parts: the camera's numbers and the detail rule, by hand.
#pragma once

#include <cmath>

#include "08_sphere_rendering/detail.h"
#include "08_sphere_rendering/orbit_camera.h"
#include "08_sphere_rendering/view_matrices.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

inline bool isNear08(float got, float expected, float tolerance = 1e-4f) {
    return std::abs(got - expected) <= tolerance * std::max(1.0f, std::abs(expected));
}

inline bool isNear08(Vec3 got, Vec3 expected) { return length(got - expected) <= 1e-4f; }

// ---- camera.orbit

struct OrbitRow {
    float yaw, pitch;
    Vec3 arm;  // from the target to the eye, at distance 2
};

/// cos 30 = 0.8660254, sin 30 = 0.5.
inline const std::vector<OrbitRow>& orbitRows() {
    static const std::vector<OrbitRow> rows{{0, 0, {0, 0, 2}},
                                            {90, 0, {2, 0, 0}},
                                            {180, 0, {0, 0, -2}},
                                            {-90, 0, {-2, 0, 0}},
                                            {30, 0, {1, 0, 1.7320508f}},
                                            {0, 30, {0, 1, 1.7320508f}},
                                            {90, 30, {1.7320508f, 1, 0}},
                                            {90, -30, {1.7320508f, -1, 0}},
                                            {30, 30, {0.8660254f, 1, 1.5f}}};
    return rows;
}

inline void orbitByHand(Report& report) {
    constexpr Vec3 target{1, 2, 3};
    const auto armOf = [&](const OrbitRow& row) {
        const OrbitCamera orbit{
            .target = target, .yaw = row.yaw, .pitch = row.pitch, .distance = 2};
        return orbit.eye() - target;
    };
    for (const OrbitRow& row : orbitRows())
        if (!isNear08(armOf(row), row.arm))
            report.fail("from the target to the eye, 2 m away at yaw " + text(row.yaw) +
                            ", pitch " + text(row.pitch),
                        text(armOf(row)), text(row.arm));
    const auto all = [&](auto twisted) {
        return [&, twisted] {
            for (const OrbitRow& row : orbitRows())
                if (!isNear08(armOf(row), twisted(row.arm))) return false;
            return true;
        };
    };
    report.guess({{"the yaw's sign: it turns to the left", all([](Vec3 arm) {
                       return Vec3{-arm.x, arm.y, arm.z};
                   })},
                  {"the pitch's sign: it goes down", all([](Vec3 arm) {
                       return Vec3{arm.x, -arm.y, arm.z};
                   })},
                  {"sine and cosine of the yaw exchanged", all([](Vec3 arm) {
                       return Vec3{arm.z, arm.y, arm.x};
                   })},
                  {"the target left out", all([=](Vec3 arm) { return arm - target; })},
                  {"the arm reversed: the eye stands behind the target",
                   all([](Vec3 arm) { return -arm; })}});
}

// ---- matrices, applied as OpenGL does: columns times the point

struct Four {
    float x, y, z, w;
};

inline Four applied(const Matrix4& m, Vec3 p) {
    const auto row = [&](std::size_t r) {
        return m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r];
    };
    return {row(0), row(1), row(2), row(3)};
}

inline Matrix4 transposed(const Matrix4& m) {
    Matrix4 t{};
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) t[4 * r + c] = m[4 * c + r];
    return t;
}

struct LookRow {
    const char* what;
    Vec3 world, eye;
};

/// The eye at (3, 0, 4) looks at the origin, 5 m away: forward is (-0.6, 0, -0.8), right is
/// (0.8, 0, -0.6), up is y.
inline const std::vector<LookRow>& lookRows() {
    static const std::vector<LookRow> rows{{"the eye", {3, 0, 4}, {0, 0, 0}},
                                           {"the target", {0, 0, 0}, {0, 0, -5}},
                                           {"2 m above the target", {0, 2, 0}, {0, 2, -5}},
                                           {"1 m to its right", {0.8f, 0, -0.6f}, {1, 0, -5}},
                                           {"1 m before the eye", {2.4f, 0, 3.2f}, {0, 0, -1}},
                                           {"1 m behind the eye", {3.6f, 0, 4.8f}, {0, 0, 1}}};
    return rows;
}

inline void lookAtByHand(Report& report) {
    const Matrix4 matrix = lookAt({{3, 0, 4}, {0, 0, 0}, {0, 1, 0}, 35});
    for (const LookRow& row : lookRows()) {
        const Four got = applied(matrix, row.world);
        if (!isNear08(Vec3{got.x, got.y, got.z}, row.eye) || !isNear08(got.w, 1))
            report.fail(std::string(row.what) + ", in eye space", text(Vec3{got.x, got.y, got.z}),
                        text(row.eye));
    }
    const auto all = [&](const Matrix4& m, auto twisted) {
        for (const LookRow& row : lookRows()) {
            const Four got = applied(m, row.world);
            if (!isNear08(Vec3{got.x, got.y, got.z}, twisted(row.eye))) return false;
        }
        return true;
    };
    const auto same = [](Vec3 p) { return p; };
    report.guess({{"transposed: rows stored where OpenGL wants columns",
                   [&] { return all(transposed(matrix), same); }},
                  {"z the wrong way: the camera looks along +z",
                   [&] { return all(matrix, [](Vec3 p) {
                             return Vec3{p.x, p.y, -p.z};
                         }); }},
                  {"left and right exchanged",
                   [&] { return all(matrix, [](Vec3 p) {
                             return Vec3{-p.x, p.y, p.z};
                         }); }},
                  {"not moved to the eye",
                   [&] { return all(matrix, [](Vec3 p) {
                             return p + Vec3{0, 0, 5};
                         }); }},
                  {"moved first by the eye's place in the world, not along the camera's axes",
                   [&] { return isNear08(matrix[12], -3) && isNear08(matrix[14], -4); }}});
}

struct ClipRow {
    const char* what;
    Vec3 eye, frame;  // in -1..1
};

/// Half the field of view is 45 degrees: at depth d the frame is 2 d high and 4 d wide. Near 1 m,
/// far 9 m: z = 1.25 - 2.25 / depth.
inline const std::vector<ClipRow>& clipRows() {
    static const std::vector<ClipRow> rows{
        {"straight ahead on the near plane", {0, 0, -1}, {0, 0, -1}},
        {"straight ahead on the far plane", {0, 0, -9}, {0, 0, 1}},
        {"straight ahead at 3 m", {0, 0, -3}, {0, 0, 0.5f}},
        {"at the upper edge, 3 m deep", {0, 3, -3}, {0, 1, 0.5f}},
        {"at the right edge, 3 m deep", {6, 0, -3}, {1, 0, 0.5f}},
        {"half way to the left and down, 9 m deep", {-9, -4.5f, -9}, {-0.5f, -0.5f, 1}}};
    return rows;
}

inline void perspectiveByHand(Report& report) {
    Camera camera;
    camera.verticalFieldOfView = 90;
    const Matrix4 matrix = perspective(camera, 2.0f, 1.0f, 9.0f);
    const auto divided = [](const Matrix4& m, Vec3 p) {
        const Four c = applied(m, p);
        return Vec3{c.x / c.w, c.y / c.w, c.z / c.w};
    };
    for (const ClipRow& row : clipRows()) {
        const Vec3 got = divided(matrix, row.eye);
        if (!isNear08(got, row.frame))
            report.fail(std::string("a point ") + row.what + ", after the division", text(got),
                        text(row.frame));
    }
    const auto all = [&](const Matrix4& m, auto twisted) {
        for (const ClipRow& row : clipRows())
            if (!isNear08(divided(m, row.eye), twisted(row.frame))) return false;
        return true;
    };
    const auto same = [](Vec3 p) { return p; };
    report.guess({{"transposed: rows stored where OpenGL wants columns",
                   [&] { return all(transposed(matrix), same); }},
                  {"no division by the distance: far things stay as large as near ones",
                   [&] {
                       return isNear08(applied(matrix, {0, 0, -3}).w, 1);
                   }},
                  {"aspect multiplied, not divided",
                   [&] { return all(matrix, [](Vec3 p) {
                             return Vec3{4 * p.x, p.y, p.z};
                         }); }},
                  {"aspect left out",
                   [&] { return all(matrix, [](Vec3 p) {
                             return Vec3{2 * p.x, p.y, p.z};
                         }); }},
                  {"near and far exchanged", [&] {
                       return all(matrix, [](Vec3 p) { return Vec3{p.x, p.y, -p.z}; });
                   }}});
}

// ---- detail

inline void radiusByHand(Report& report) {
    struct Row {
        Vec3 place;
        float radius, pixels;
    };
    const Camera camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 90};  // at 10 m the frame is 20 m high
    const std::vector<Row> rows{
        {{0, 0, 0}, 1, 10},    {{0, 0, 0}, 2, 20}, {{0, 0, 5}, 1, 20},
        {{0, 0, -10}, 1, 5},   {{7, 0, 0}, 1, 10},  // aside: the depth is what counts
        {{0, 0, 9.5f}, 1, 200}};
    const auto of = [&](const Row& row) { return pixelRadius(camera, 200, row.place, row.radius); };
    for (const Row& row : rows)
        if (!isNear08(of(row), row.pixels))
            report.fail("radius in pixels of a ball of " + text(row.radius) + " m at " +
                            text(row.place) + ", the eye at (0, 0, 10)",
                        text(of(row)), text(row.pixels));
    report.guess(
        {{"the diameter, not the radius", [&] { return isNear08(of(rows[0]), 20); }},
         {"half the frame's height for the whole", [&] { return isNear08(of(rows[0]), 20); }},
         {"the whole height for half of it", [&] { return isNear08(of(rows[0]), 5); }},
         {"the distance to the eye for the depth",
          [&] { return isNear08(of(rows[0]), 10) && !isNear08(of(rows[4]), 10); }},
         {"the depth left out", [&] { return isNear08(of(rows[2]), of(rows[0])); }}});
}

/// How far the middle of an edge lies inside the circle.
inline double outlineError(double pixels, int slices) {
    return pixels * (1 - std::cos(3.14159265358979323846 / slices));
}

inline void slicesByTable(Report& report) {
    struct Row {
        float pixels;
        int slices;
    };
    for (const Row& row : {Row{0.2f, 6}, Row{1, 6}, Row{2, 6}, Row{4, 8}, Row{8, 10}, Row{16, 14},
                           Row{32, 18}, Row{64, 26}, Row{128, 36}, Row{256, 52}, Row{540, 74}})
        if (slicesFor(row.pixels) != row.slices)
            report.fail("slices for a radius of " + text(row.pixels) + " pixels",
                        text(slicesFor(row.pixels)), text(row.slices));
    for (float pixels = 0.1f; pixels < 2000; pixels *= 1.1f) {
        const int slices = slicesFor(pixels);
        if (slices % 2 != 0 || slices < 6)
            report.fail("slices for " + text(pixels) + " pixels", text(slices),
                        "even, and at least 6");
        else if (outlineError(double(pixels), slices) > 0.5001)
            report.fail(
                "error of the outline for " + text(pixels) + " pixels, " + text(slices) + " slices",
                text(float(outlineError(double(pixels), slices))), "at most 0.5 pixels");
        else if (slices > 6 && outlineError(double(pixels), slices - 2) < 0.4999)
            report.fail("slices for " + text(pixels) + " pixels", text(slices),
                        "fewer: " + text(slices - 2) + " are enough");
    }
    report.guess({{"slices from the diameter", [] { return slicesFor(64) == 36; }},
                  {"a whole turn for half of one: twice the slices",
                   [] { return slicesFor(64) == 50 || slicesFor(64) == 52; }},
                  {"half of the slices: the error of a quarter turn",
                   [] { return slicesFor(64) == 12 || slicesFor(64) == 14; }},
                  {"rounded down", [] { return slicesFor(64) == 24; }},
                  {"one whole pixel of error", [] { return slicesFor(64) == 18; }}});
    std::string answer = "slices for a radius of";
    for (const float pixels : {10.0f, 40.0f, 160.0f})
        answer += " " + text(static_cast<int>(pixels)) + " pixels: " + text(slicesFor(pixels)) +
                  (pixels < 160 ? "," : "");
    report.measured(answer);
}

}  // namespace ballpit::check
