// Chapter 10's checks of the single stages, each called by itself on a few bodies.
#pragma once

#include <numeric>

#include "common/host_pairs.h"
#include "tests/checks/check_10_oracle.cuh"

namespace ballpit::check {

inline void copies(Report& report) {
    bool isNext = true;
    for (std::size_t committed = 0; committed < 3; ++committed)
        for (std::size_t inUse = 0; inUse < 3; ++inUse) {
            const std::size_t got = otherWorkingCopy(committed, inUse);
            isNext = isNext && got == (inUse + 1) % 3;
            std::string expected;
            for (std::size_t copy = 0; copy < 3; ++copy)
                if (copy != committed && copy != inUse)
                    expected += (expected.empty() ? "" : " or ") + text(copy);
            if (got == committed || got == inUse || got > 2)
                report.fail("committed " + text(committed) + ", in use " + text(inUse) + ": free",
                            text(got), expected);
        }
    report.guess(
        {{"the next copy in the ring, which may be the committed one", [&] { return isNext; }}});
}

inline Scene fewBalls() {
    Scene scene{"few", {}, {{-10, -10, -10}, {10, 10, 10}}, 2.0f, {0, -10, 0}, 0.5f, 0.1f};
    scene.spheres.add({1.9f, 4.05f, 0.1f}, {2, 0, -1}, 0.5f, 4, 1);
    scene.spheres.add({-5, 0.3f, 0.7f}, {0, 1, 0}, 0.25f, 1, 0.5f);
    scene.spheres.add({7, 7, 7}, {30, 0, 0}, 0.5f, 2, 0.5f);
    return scene;
}

/// The cells of 2 m in which these balls lie, by the formula of chapter 02.
inline std::vector<std::uint32_t> cellsOf(const Spheres& balls) {
    std::vector<std::uint32_t> cells;
    for (const Vec3 p : balls.positions) {
        const auto axis = [](float x) {
            return static_cast<std::uint32_t>(std::clamp(std::floor((x + 10.0) / 2.0), 0.0, 9.0));
        };
        cells.push_back((axis(p.z) * 10 + axis(p.y)) * 10 + axis(p.x));
    }
    return cells;
}

inline void integrateStage(Report& report) {
    const Scene scene = fewBalls();
    Probe probe(scene, report.device);
    const Copies state = probe.bodies().state(), to{(state.moving + 1) % 3, state.fixed};
    probe.integrate(state, to);
    Spheres got = scene.spheres, expected = scene.spheres;
    if (!readCopies(report, probe, to, got)) return;
    // v = 0.95 (v + 0.1 g), x += 0.1 v; ball 2 flies through the wall, and comes back with half.
    expected.velocities = {{1.9f, -0.95f, -0.95f}, {0, 0, 0}, {-14.25f, -0.95f, 0}};
    expected.positions = {{2.09f, 3.955f, 0.005f}, {-5, 0.3f, 0.7f}, {9.5f, 6.905f, 7}};
    requireSameBalls(report, "after integrate", got, expected);
    const std::vector<std::uint32_t> hashes = probe.grid().hashes.download();
    const std::vector<std::uint32_t> right = cellsOf(expected);
    sameElements(report, hashes, right, [](std::size_t k) { return "hash of slot " + text(k); });
    requireUntouched(report, "the copy that was read", probe.bodies().download(), scene.spheres);
    Scene twice = scene;
    moveOnHost(twice.spheres, scene);
    moveOnHost(twice.spheres, scene);
    report.guess({{"nothing was written to the other copy",
                   [&] { return got.positions[0].x == 0.0f || !isFinite(got.positions[0]); }},
                  {"hashed before the bodies moved: the cells are those from before",
                   [&] { return hashes == cellsOf(scene.spheres); }},
                  {"the bodies moved twice", [&] { return sameBalls(got, twice.spheres); }}});
}

/// Balls on a loose lattice in a random order, some twice as dense as others.
inline Scene manyBalls(int count, std::uint64_t seed) {
    Scene scene = fewBalls();
    scene.spheres = {};
    Random random(seed);
    for (int k = 0; k < count; ++k)
        scene.spheres.add(random.uniformIn({{-6, -6, -6}, {6, 6, 6}}),
                          random.uniformIn({{-3, -3, -3}, {3, 3, 3}}), random.uniform(0.4f, 0.9f),
                          random.uniform(0.5f, 4.0f), random.uniform(0.0f, 1.0f));
    return scene;
}

/// Compares cell by cell; remembers what is wrong with those that should be empty or full.
struct CellFaults {
    std::size_t ghosts = 0, deserted = 0, full = 0;
};

inline CellFaults requireCells(Report& report, const UniformGrid& grid,
                               const std::vector<std::uint32_t>& sortedHashes) {
    CellFaults faults;
    const std::vector<std::uint32_t> starts = grid.cellStarts.download();
    const std::vector<std::uint32_t> ends = grid.cellEnds.download();
    for (std::uint32_t cell = 0; cell < starts.size(); ++cell) {
        const auto [first, last] = std::equal_range(sortedHashes.begin(), sortedHashes.end(), cell);
        const auto begin = static_cast<std::uint32_t>(first - sortedHashes.begin());
        const auto end = static_cast<std::uint32_t>(last - sortedHashes.begin());
        const bool isEmpty = begin == end, saidEmpty = starts[cell] >= ends[cell];
        faults.full += !isEmpty;
        faults.ghosts += isEmpty && !saidEmpty;
        faults.deserted += !isEmpty && saidEmpty;
        if (isEmpty ? saidEmpty : starts[cell] == begin && ends[cell] == end) continue;
        report.fail("slots of cell " + text(cell),
                    saidEmpty ? "none" : text(starts[cell]) + " to " + text(ends[cell] - 1),
                    isEmpty ? "none" : text(begin) + " to " + text(end - 1));
    }
    return faults;
}

inline void buildGridStage(Report& report) {
    Probe probe(manyBalls(300, report.seed), report.device);
    for (const std::uint64_t build : {1, 2}) {  // the second finds what the first has left
        const Scene scene = manyBalls(300, report.seed + build);
        probe.bodies().upload(scene.spheres);
        const Copies state = probe.bodies().state(), to = Probe::others(state);
        const std::vector<std::uint32_t> leftBefore = probe.grid().sortedIndices.download();
        probe.hash(state);
        probe.buildGrid(state, to);
        const std::vector<std::uint32_t> hashes = probe.grid().hashes.download();
        std::vector<std::uint32_t> order(hashes.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return hashes[a] < hashes[b]; });
        std::vector<std::uint32_t> sortedHashes;
        for (const std::uint32_t k : order) sortedHashes.push_back(hashes[k]);
        const std::string which = build == 1 ? "" : ", built again";
        const std::vector<std::uint32_t> ids = probe.bodies().idsInMemoryOrder(to);
        sameElements(report, ids, order,
                     [&](std::size_t k) { return "body in slot " + text(k) + which; });
        const CellFaults faults = requireCells(report, probe.grid(), sortedHashes);
        report.guess({{"the bodies were moved in the order of the sort before: sort first",
                       [&] { return ids == leftBefore && ids != order; }},
                      {"no cell holds anybody: were the cells cleared after they were found?",
                       [&] { return faults.full > 0 && faults.deserted == faults.full; }},
                      {"cells of the build before are still there: nobody cleared them",
                       [&] { return faults.ghosts > 0; }}});
        if (report.failed()) return;
        Spheres got;
        if (readCopies(report, probe, to, got))
            requireUntouched(report, "bodies in cell order", got, scene.spheres);
    }
}

inline void detectStage(Report& report) {
    for (const int count : {1, 2, 33, 300}) {
        const Scene scene = manyBalls(count, report.seed + 3);
        Probe probe(scene, report.device);
        const Copies sorted = probe.sorted();
        probe.detectCollisions(sorted);
        const Pairs right = findPairsOnHost(scene.spheres);
        const StepStatus status = probe.report();
        const std::string where = " (" + text(count) + " balls)";
        if (status.collisions != right.size())
            report.fail("pairs that the host is told of" + where, text(status.collisions),
                        text(right.size()));
        samePairs(report, probe.pairs(sorted), right, [&](Pair) { return where; });
        if (report.failed()) return;
    }
}

/// A light ball that a heavy one pushes by `overlap` m. Is the grid stale then?
inline bool isStale(Device device, float overlap, float motionShare) {
    Scene scene = fewBalls();
    scene.spheres = {};
    scene.spheres.add({0, 0, 0}, {}, 0.5f, 1e6f, 0);
    scene.spheres.add({1 - overlap, 0, 0}, {}, 0.5f, 1, 0);
    Probe probe(scene, device);
    const Copies sorted = probe.sorted();
    probe.detectCollisions(sorted);
    probe.resolveCollisions(sorted, Probe::others(sorted), motionShare);
    return probe.report().staleGrid != 0;
}

inline void resolveStage(Report& report) {
    const Scene scene = manyBalls(200, report.seed + 4);
    Probe probe(scene, report.device);
    const Copies sorted = probe.sorted();
    probe.detectCollisions(sorted);
    const Copies to{(sorted.moving + 1) % 3, sorted.fixed};
    probe.resolveCollisions(sorted, to, 1.0f);
    Spheres got, source;
    if (!readCopies(report, probe, to, got) || !readCopies(report, probe, sorted, source)) return;
    requireUntouched(report, "the copy that was read", source, scene.spheres);
    const Spheres expected =
        oracle({scene.spheres, findPairsOnHost(scene.spheres)}, {.split = true});
    requireSameBalls(report, "after one round", got, expected, 2e-4f);
    report.guess(
        {{"nothing was resolved", [&] { return stateHash(got) == stateHash(scene.spheres); }}});
    struct Push {
        float overlap, share;
        bool stale;
    };
    // Cells of 2 m, balls of 0.5 m: the grid bears a way of 0.5 m in all rounds together.
    bool mayGoTooFar = false;
    for (const Push push :
         {Push{0.4f, 1, false}, {0.7f, 1, true}, {0.4f, 0.5f, true}, {0.2f, 0.5f, false}}) {
        const bool got = isStale(report.device, push.overlap, push.share);
        mayGoTooFar = mayGoTooFar || (push.stale && !got);
        if (got != push.stale)
            report.fail("a push of " + text(push.overlap) + " m in a grid that bears " +
                            text(0.5f * push.share) + " m: is it stale?",
                        got ? "yes" : "no", push.stale ? "yes" : "no");
    }
    report.guess({{"a ball may move as far as the whole cell allows, and the grid bears half",
                   [&] { return mayGoTooFar; }}});
}

}  // namespace ballpit::check
