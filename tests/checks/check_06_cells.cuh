// Chapter 06: which runs of slots a search takes. Grids whose cells are filled by hand; the balls
// in them have no places yet.
#pragma once

#include "tests/checks/check_06_search.cuh"

namespace ballpit::check {

inline bool isEmpty(SlotRange run) { return run.begin >= run.end; }
inline bool sameSlots(SlotRange a, SlotRange b) {
    return (isEmpty(a) && isEmpty(b)) || (a.begin == b.begin && a.end == b.end);
}
inline std::string text(SlotRange run) {
    return isEmpty(run) ? "no slots" : "slots " + text(run.begin) + " to " + text(run.end - 1);
}

inline Pairs asPairs(const SearchRanges& ranges) {
    Pairs runs;
    for (const SlotRange run : ranges.rows) runs.push_back({run.begin, run.end});
    return runs;
}

/// Behind the world's last cell lie others with a ball each, so that a search that leaves the world
/// finds something.
class HandGrid {
public:
    /// `population`: how many balls each cell holds.
    HandGrid(Int3 resolution, const Words& population)
        : resolution(resolution),
          starts_(Device::cpu, population.size() + beyond, "cellStarts"),
          ends_(Device::cpu, population.size() + beyond, "cellEnds"),
          hashes_(Device::cpu, 0, "sortedHashes") {
        Words starts, ends, hashes;
        for (std::uint32_t cell = 0; cell < population.size() + beyond; ++cell) {
            const std::uint32_t balls = cell < population.size() ? population[cell] : 1;
            starts.push_back(ends.empty() ? 0 : ends.back());
            ends.push_back(starts.back() + balls);
            if (cell >= population.size()) continue;
            cells.push_back(cellNumbered(resolution, cell));
            hashes.insert(hashes.end(), balls, cell);
        }
        starts_.upload(starts);
        ends_.upload(ends);
        hashes_.resize(hashes.size());
        hashes_.upload(hashes);
        slotCount = static_cast<std::uint32_t>(hashes.size());
    }

    /// The slots of all cells with the same y and z, at most one step away in x.
    SlotRange rightRow(Int3 cell, int dy, int dz) const {
        SlotRange run{0, 0};
        const Words starts = starts_.download(), ends = ends_.download();
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const Int3 there = cells[c];
            if (there.y != cell.y + dy || there.z != cell.z + dz) continue;
            if (there.x < cell.x - 1 || there.x > cell.x + 1) continue;
            if (isEmpty(run)) run.begin = starts[c];
            run.end = ends[c];
        }
        return run;
    }

    GridView view() { return {{0, 0, 0}, 1.0f, resolution, starts_.view(), ends_.view()}; }
    View<const std::uint32_t> sortedHashes() { return hashes_.view(); }
    Int3 cellOfSlot(std::uint32_t slot) const { return cells.at(hashes_.download()[slot]); }

    Int3 resolution;
    std::vector<Int3> cells;
    std::uint32_t slotCount = 0;

private:
    static constexpr std::uint32_t beyond = 64;
    DeviceBuffer<std::uint32_t> starts_, ends_, hashes_;
};

/// All grids of 1 to 3 cells a side.
inline std::vector<Int3> smallResolutions() {
    std::vector<Int3> all;
    for (int z = 1; z <= 3; ++z)
        for (int y = 1; y <= 3; ++y)
            for (int x = 1; x <= 3; ++x) all.push_back({x, y, z});
    return all;
}

inline Words population(Int3 resolution, std::uint64_t most, std::uint64_t seed) {
    Random random(seed);
    Words balls(static_cast<std::size_t>(resolution.x * resolution.y * resolution.z), 1);
    for (std::uint32_t& count : balls)
        count = static_cast<std::uint32_t>(random.next() % (most + 1));
    return balls;
}

/// A row that a search asks for: two of its three cells may lie beyond the world, or all.
struct AskedRow {
    Int3 cell;
    int dy, dz;
};
constexpr AskedRow askedRows[] = {{{}, 0, 0}, {{}, 1, 0}, {{}, -1, 1}, {{}, 0, 1}, {{}, 1, 1}};

/// Compares one row, and guesses.
inline void requireRow(Report& report, HandGrid& grid, AskedRow asked) {
    const SlotRange got = rowBeside(grid.view(), asked.cell, asked.dy, asked.dz);
    const SlotRange expected = grid.rightRow(asked.cell, asked.dy, asked.dz);
    if (sameSlots(got, expected)) return;
    report.fail("row (" + text(asked.dy) + ", " + text(asked.dz) + ") beside cell " +
                    text(asked.cell) + " in a world of " + text(grid.resolution) + " cells",
                text(got), text(expected));
    const int y = asked.cell.y + asked.dy;
    const bool rowExists = y >= 0 && y < grid.resolution.y;
    report.guess(
        {{"a search that wraps around the edge of the world: row -1 and row resolution.y do not "
          "exist, and hash arithmetic does not know that",
          [&] { return !rowExists && !isEmpty(got); }},
         {"a search that wraps around the edge of the world: left of a row's first cell lies the "
          "last cell of another row",
          [&] {
              const bool atEdge = asked.cell.x == 0 || asked.cell.x + 1 == grid.resolution.x;
              return rowExists && atEdge && got.end - got.begin > expected.end - expected.begin;
          }},
         {"one cell of the row only: its neighbours left and right belong to the run",
          [&] { return rowExists && got.end - got.begin == 1; }}});
}

// ---- the checks

inline void rows(Report& report) {
    // First where even a search that leaves the world stays in memory.
    HandGrid middle({3, 3, 3}, Words(27, 1));
    for (const Int3 cell : middle.cells)
        for (const AskedRow row : askedRows)
            if (cell.z == 1) requireRow(report, middle, {cell, row.dy, row.dz});
    if (report.failed()) return;
    for (const Int3 resolution : smallResolutions()) {
        HandGrid grid(resolution, population(resolution, 3, report.seed));
        for (const Int3 cell : grid.cells)
            for (const AskedRow row : askedRows) requireRow(report, grid, {cell, row.dy, row.dz});
    }
}

inline void rangesByHand(Report& report) {
    // A ball in each of 4 x 4 x 4 cells; ball 21 lies in cell (1, 1, 1).
    HandGrid grid({4, 4, 4}, Words(64, 1));
    const Pairs got = asPairs(rangesAfter(21, grid.view(), grid.sortedHashes()));
    const Pairs expected{{22, 23}, {24, 27}, {32, 35}, {36, 39}, {40, 43}};
    for (std::size_t k = 0; k < got.size(); ++k)
        if (!(got[k] == expected[k]))
            report.fail("run " + text(k) + " of ball 21",
                        text(SlotRange{got[k].first, got[k].second}),
                        text(SlotRange{expected[k].first, expected[k].second}));
    report.guess({{"26 cells: the own cell is missing, and with it the balls that share it",
                   [&] { return got[0].first > 22; }},
                  {"a ball compared with itself: the search starts behind slot i",
                   [&] { return got[0].first == 21; }},
                  {"pairs found from both sides: only slots after i are searched",
                   [&] { return got[0].first < 21; }},
                  {"the own row ends with the own cell: the cell to the right is missing", [&] {
                       return got[0] == Pair{22, 22};
                   }}});
}

/// Of two balls in neighbouring cells one searches for the other, and no other ball does.
inline void requireMutualSearch(Report& report, HandGrid& grid) {
    const std::uint32_t count = grid.slotCount;
    std::vector<int> times(count * count, 0);
    for (std::uint32_t i = 0; i < count; ++i)
        for (const SlotRange run :
             rangesAfter(static_cast<int>(i), grid.view(), grid.sortedHashes()).rows)
            for (std::uint32_t j = run.begin; j < run.end; ++j)
                if (j < count) ++times[i * count + j];
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = i; j < count; ++j) {
            const Int3 a = grid.cellOfSlot(i), b = grid.cellOfSlot(j);
            const int expected = i != j && areNeighbours(a, b) ? 1 : 0;
            const int back = i != j ? times[j * count + i] : 0;
            if (times[i * count + j] == expected && back == 0) continue;
            report.fail("ball " + text(i) + " in cell " + text(a) + " and ball " + text(j) +
                            " in cell " + text(b) + " of " + text(grid.resolution),
                        "compared " + text(times[i * count + j] + back) + "x",
                        text(expected) + "x, by ball " + text(i));
        }
}

inline void ranges(Report& report) {
    rangesByHand(report);
    if (report.failed()) return;
    for (const Int3 resolution : smallResolutions()) {
        HandGrid grid(resolution, population(resolution, 3, report.seed));
        requireMutualSearch(report, grid);
    }
}

}  // namespace ballpit::check
