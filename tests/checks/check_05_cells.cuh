// For the checks of chapter 05: runs the piece on sorted hashes, counts what is right, and draws.
// The oracle counts hashes cell by cell, so it shares neither comparisons of neighbours nor
// clearing with the piece.
#pragma once

#include "05_cell_bounds/cell_bounds.cuh"

#include <algorithm>

#include "common/random.h"
#include "tests/checks/canvas.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

using Hashes = std::vector<std::uint32_t>;  ///< sorted, one a slot

/// What the arrays hold before the first frame: the bounds of no cell.
constexpr std::uint32_t staleStart = 5, staleEnd = 4000000;

/// Cells of 1 m, with stale bounds.
inline UniformGrid staleGrid(Device device, Int3 cells) {
    UniformGrid grid(device, {{0, 0, 0}, {float(cells.x), float(cells.y), float(cells.z)}}, 1, 1);
    grid.cellStarts.upload(Hashes(grid.cellCount(), staleStart));
    grid.cellEnds.upload(Hashes(grid.cellCount(), staleEnd));
    return grid;
}

/// The starts and ends of all cells.
struct CellBounds {
    Hashes starts, ends;
    bool operator==(const CellBounds&) const = default;
};

/// One frame: clears the cells and finds those of these slots. The array of hashes has no element
/// more, so that reading past its end is seen.
inline CellBounds findCells(UniformGrid& grid, const Hashes& hashes) {
    const Device device = grid.cellStarts.device();
    const int count = static_cast<int>(hashes.size());
    auto sorted = uploaded(device, hashes, "sortedHashes");
    clearCells(grid);
    launch<findCellStart>(device, count, count, View<const std::uint32_t>(sorted.view()),
                          grid.view());
    return {grid.cellStarts.download(), grid.cellEnds.download()};
}
inline CellBounds findCells(Device device, Int3 cells, const Hashes& hashes) {
    UniformGrid grid = staleGrid(device, cells);
    return findCells(grid, hashes);
}

// ---- what is right

inline std::uint32_t slotsBelow(const Hashes& hashes, std::uint32_t cell) {
    return static_cast<std::uint32_t>(
        std::count_if(hashes.begin(), hashes.end(), [&](std::uint32_t h) { return h < cell; }));
}
/// The slots of cells first..last.
inline SlotRange expectedRun(const Hashes& hashes, std::uint32_t first, std::uint32_t last) {
    return {slotsBelow(hashes, first), slotsBelow(hashes, last + 1)};
}

inline std::string inWords(SlotRange run) {
    if (run.begin >= run.end) return "no slots";
    return "slots " + text(run.begin) + " to " + text(run.end - 1);
}
/// Empty runs are equal, wherever they begin.
inline bool sameRun(SlotRange a, SlotRange b) {
    return a.begin >= a.end ? b.begin >= b.end : a.begin == b.begin && a.end == b.end;
}

// ---- the classic mistakes

/// True if `test(cell's bounds, right bounds, cell)` holds for every occupied cell.
template <class Test>
bool inEveryCell(const Hashes& hashes, const CellBounds& got, Test test) {
    for (const std::uint32_t cell : hashes)
        if (!test(SlotRange{got.starts[cell], got.ends[cell]}, expectedRun(hashes, cell, cell),
                  cell))
            return false;
    return !hashes.empty();
}

inline void guessMistake(Report& report, const Hashes& hashes, const CellBounds& got) {
    const auto matches = [&](auto test) {
        return [&, test] { return inEveryCell(hashes, got, test); };
    };
    report.guess(
        {{"the last end is missing: nobody comes after the last slot, and yet it ends a cell",
          matches([&](SlotRange g, SlotRange e, std::uint32_t cell) {
              return g.begin == e.begin && (g.end == e.end) == (cell != hashes.back());
          })},
         {"the first start is missing: nobody comes before slot 0, and yet it starts a cell",
          matches([&](SlotRange g, SlotRange e, std::uint32_t cell) {
              return g.end == e.end && (g.begin == e.begin) == (cell != hashes.front());
          })},
         {"the end is the last slot: it must be one past it",
          matches([](SlotRange g, SlotRange e, std::uint32_t) {
              return g.begin == e.begin && g.end + 1 == e.end;
          })},
         {"every slot writes the start of its cell: which of them comes last is up to the machine",
          matches([](SlotRange g, SlotRange e, std::uint32_t) {
              return g.begin + 1 == e.end && g.end == e.end;
          })}});
}

/// Every occupied cell must have its slots.
inline bool requireCells(Report& report, const Hashes& hashes, const CellBounds& got) {
    for (std::uint32_t cell = 0; cell < got.starts.size(); ++cell) {
        const SlotRange expected = expectedRun(hashes, cell, cell);
        if (expected.begin == expected.end) continue;
        if (got.starts[cell] != expected.begin)
            report.fail("start of cell " + text(cell), text(got.starts[cell]),
                        text(expected.begin));
        if (got.ends[cell] != expected.end)
            report.fail("end of cell " + text(cell), text(got.ends[cell]), text(expected.end));
    }
    if (report.failed()) guessMistake(report, hashes, got);
    return !report.failed();
}

// ---- scenes and pictures

inline Hashes randomHashes(int count, std::uint32_t cells, std::uint64_t seed) {
    Random random(seed);
    Hashes hashes;
    for (int k = 0; k < count; ++k)
        hashes.push_back(static_cast<std::uint32_t>(random.next() % cells));
    std::sort(hashes.begin(), hashes.end());
    return hashes;
}

/// Yours, reference, and what differs in red: a square layer of cells, darker where more balls are.
inline Frame drawOccupancy(int side, const Hashes& hashes, const CellBounds& got) {
    const auto draw = [&](Canvas& canvas, const Panel& panel, int k) {
        for (int cell = 0; cell < side * side; ++cell) {
            const auto c = static_cast<std::uint32_t>(cell);
            const SlotRange right = expectedRun(hashes, c, c);
            const SlotRange mine{got.starts[c], got.ends[c]};
            const SlotRange run = k == 0 ? mine : right;
            const float balls =
                run.begin < run.end ? std::min(6.0f, float(run.end - run.begin)) : 0.0f;
            const float share = balls / 6.0f;
            Vec3 color = (1.0f - share) * colors::paper + share * Vec3{0.05f, 0.25f, 0.6f};
            if (k == 2) color = sameRun(mine, right) ? colors::paper : colors::red;
            const auto x = static_cast<float>(cell % side), z = static_cast<float>(cell / side);
            canvas.rectangle(panel.x(x) + 1, panel.y(z + 1) + 1, panel.x(x + 1) - 1, panel.y(z) - 1,
                             colors::line);
            canvas.rectangle(panel.x(x) + 2, panel.y(z + 1) + 2, panel.x(x + 1) - 2, panel.y(z) - 2,
                             color);
        }
    };
    return threePanels(0, 0, static_cast<float>(side), 304, draw);
}

}  // namespace ballpit::check
