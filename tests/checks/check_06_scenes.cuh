// Chapter 06: scenes that are hard for a search in a grid, and the picture of a flat one.
#pragma once

#include "tests/checks/canvas.h"
#include "tests/checks/check_06_search.cuh"

namespace ballpit::check {

constexpr Bounds tenCube{{-5, -5, -5}, {5, 5, 5}};

/// Five balls in a row of four cells of 1 m. Touching: 0-1, 0-2, 1-2, 1-3, 2-3.
//@show five_balls
inline const Scene06 fiveBalls{"five balls in a row",
                               {{0.5f, 0.5f, 0.5f, 0.5f},   // slot 0, cell 0
                                {1.3f, 0.5f, 0.5f, 0.5f},   // slot 1, cell 1
                                {1.4f, 0.5f, 0.5f, 0.5f},   // slot 2, cell 1
                                {2.2f, 0.5f, 0.5f, 0.5f},   // slot 3, cell 2
                                {3.9f, 0.5f, 0.5f, 0.5f}},  // slot 4, cell 3
                               {{0, 0, 0}, {4, 1, 1}}};
//@end
inline const Pairs pairsOfFive{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}};
inline const Words startsOfFive{0, 2, 4, 5, 5, 5};

inline Scene06 crowd(int count, Vec3 place = {-1.5f, 2.5f, -0.5f}) {
    return {text(count) + " balls in one place",
            Balls(static_cast<std::size_t>(count), withW(place, 0.5f)), tenCube};
}

/// Every cell face, edge and corner has a ball; so has every face of the world.
inline Scene06 onFaces() {
    Scene06 scene{"on faces and corners", {}, {{-1, -1, -1}, {1, 1, 1}}};
    for (int k = 0; k < 125; ++k)
        scene.balls.push_back({-1 + 0.5f * static_cast<float>(k % 5),
                               -1 + 0.5f * static_cast<float>(k / 5 % 5),
                               -1 + 0.5f * static_cast<float>(k / 25), 0.5f});
    return scene;
}

inline Scene06 withOutlier(std::uint64_t seed) {
    Scene06 scene{"one far away", scattered(200, tenCube, 0.3f, 0.5f, seed), tenCube};
    scene.balls.push_back({3e7f, -2e9f, 1e30f, 0.5f});
    return scene;
}

inline std::vector<Scene06> hardScenes(std::uint64_t seed) {
    const auto balls = [&](int count, Bounds box) {
        return scattered(count, box, 0.2f, 0.5f, seed);
    };
    std::vector<Scene06> scenes{
        {"negative coordinates",
         balls(60, {{-9, -9, -9}, {-6, -6, -6}}),
         {{-9, -9, -9}, {0, 0, 0}}},
        {"on both sides of zero", balls(60, {{-1.5f, -1.5f, -1.5f}, {1.5f, 1.5f, 1.5f}}), tenCube},
        onFaces(),
        crowd(33),
        {"all in one cell", balls(40, {{2, -3, 1}, {2.99f, -2.01f, 1.99f}}), tenCube},
        {"outside the world", balls(300, {{-4, -4, -4}, {4, 4, 4}}), {{-2, -2, -2}, {2, 2, 2}}},
        withOutlier(seed)};
    for (int z = 1; z <= 3; ++z)
        for (int y = 1; y <= 3; ++y)
            for (int x = 1; x <= 3; ++x) {
                const Bounds box{{0, 0, 0}, {float(x), float(y), float(z)}};
                scenes.push_back({"a world of " + text(Int3{x, y, z}) + " cells",
                                  balls(10 * x * y * z, box), box});
            }
    return scenes;
}

/// Balls on a table, seen from above: every direction of the picture has rows and cells.
inline Scene06 table(std::uint64_t seed) {
    const Bounds top{{-6, 0, -6}, {6, 1, 6}};
    return {"balls on a table",
            scattered(110, {{-5.7f, 0.5f, -5.7f}, {5.7f, 0.5f, 5.7f}}, 0.3f, 0.6f, seed), top,
            1.2f};
}

/// The pairs that a search compares: all slots of its runs.
inline Pairs candidatesOf(Ground& ground) {
    Pairs candidates;
    for (int i = 0; i < ground.grid.count(); ++i)
        for (const auto [begin, end] :
             rangesAfter(i, ground.grid.view(), ground.grid.sortedHashes()).rows)
            for (std::uint32_t j = begin; j < std::min<std::size_t>(end, ground.balls.size()); ++j)
                candidates.push_back({static_cast<std::uint32_t>(i), j});
    return candidates;
}
inline Pairs rightCandidates(const Ground& ground) {
    Pairs candidates;
    for (std::uint32_t a = 0; a < ground.cells.size(); ++a)
        for (std::uint32_t b = a + 1; b < ground.cells.size(); ++b)
            if (areNeighbours(ground.cells[a], ground.cells[b])) candidates.push_back({a, b});
    return candidates;
}

inline void drawLines(Canvas& canvas, const Panel& panel, const Balls& balls, const Pairs& pairs,
                      float thickness, Vec3 color) {
    for (const Pair p : pairs) {
        if (p.first >= balls.size() || p.second >= balls.size()) continue;
        const Vec4 a = balls[p.first], b = balls[p.second];
        canvas.line(panel.x(a.x), panel.y(a.z), panel.x(b.x), panel.y(b.z), thickness, color);
    }
}

/// Yours, reference, errors. Who is compared is joined in grey, who touches in blue; in the third
/// panel what is wrong with the pairs.
inline Frame drawSearch(const Scene06& scene, Pairs got) {
    Ground ground(Device::cpu, scene);
    const Pairs right = touchingPairs(ground.balls);
    std::sort(got.begin(), got.end());
    Pairs wrong;
    std::set_symmetric_difference(got.begin(), got.end(), right.begin(), right.end(),
                                  std::back_inserter(wrong));
    return threePanels(-6.6f, -6.6f, 13.2f, 340, [&](Canvas& canvas, const Panel& panel, int k) {
        for (int cut = 0; cut <= 10; ++cut) {
            const float at = -6.0f + 1.2f * static_cast<float>(cut);
            canvas.line(panel.x(at), panel.y(-6), panel.x(at), panel.y(6), 1, colors::line);
            canvas.line(panel.x(-6), panel.y(at), panel.x(6), panel.y(at), 1, colors::line);
        }
        for (const Vec4 ball : ground.balls)
            canvas.ring(panel.x(ball.x), panel.y(ball.z), panel.scale * ball.w, 1, colors::line);
        if (k < 2)
            drawLines(canvas, panel, ground.balls,
                      k == 0 ? candidatesOf(ground) : rightCandidates(ground), 1, colors::grey);
        const Pairs& pairs = k == 0 ? got : k == 1 ? right : wrong;
        drawLines(canvas, panel, ground.balls, pairs, 3, k < 2 ? colors::blue : colors::red);
        for (const Vec4 ball : ground.balls)
            canvas.disc(panel.x(ball.x), panel.y(ball.z), 2.5f, colors::ink);
    });
}

}  // namespace ballpit::check
