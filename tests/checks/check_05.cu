// Checks of chapter 05: where each cell starts and ends.
#include "05_cell_bounds/cell_bounds.cuh"

#include "tests/checks/check_05_cells.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

constexpr Int3 twelveCells{12, 1, 1};
constexpr int counts[] = {0, 1, 2, 33, 255, 256, 257, 1000};

//@show eight_balls
/// Eight balls in a row of twelve cells: one in cell 0, two in 2, three in 3, one in 7, one in 11.
const Hashes eightBalls{0, 2, 2, 3, 3, 3, 7, 11};
//@end

/// The same list, for functions that are called on the host.
View<const std::uint32_t> onHost(DeviceBuffer<std::uint32_t>& buffer) { return buffer.view(); }

/// slotsOfRow of cells first..first + length - 1, for every first.
HD inline void readRow(int first, GridView grid, int length, View<SlotRange> rows) {
    rows[first] = slotsOfRow(grid, static_cast<std::uint32_t>(first),
                             static_cast<std::uint32_t>(first + length - 1));
}

// ---- the checks

void clear(Report& report) {
    UniformGrid grid = staleGrid(report.device, twelveCells);
    clearCells(grid);
    const Hashes starts = grid.cellStarts.download(), ends = grid.cellEnds.download();
    for (std::size_t cell = 0; cell < starts.size(); ++cell) {
        if (starts[cell] != noStart)
            report.fail("start of cell " + text(cell), text(starts[cell]), text(noStart));
        if (ends[cell] != 0) report.fail("end of cell " + text(cell), text(ends[cell]), "0");
    }
    report.guess({{"cells that are not cleared: they hold the bounds of the frame before",
                   [&] { return ends[0] == staleEnd; }},
                  {"a start of 0 in an empty cell: read with an end from beside it, that is a run",
                   [&] { return starts[0] == 0; }}});
}

void row(Report& report) {
    UniformGrid grid = staleGrid(report.device, {4, 1, 1});
    grid.cellStarts.upload(Hashes{10, 11, 12, 13});
    grid.cellEnds.upload(Hashes{20, 21, 22, 23});
    DeviceBuffer<SlotRange> rows(report.device, 2, "rows");
    rows.fill(0);
    launch<readRow>(report.device, 2, grid.view(), 3, rows.view());
    const std::vector<SlotRange> got = rows.download();
    for (std::uint32_t first = 0; first < 2; ++first)
        if (got[first].begin != 10 + first || got[first].end != 22 + first)
            report.fail("cells " + text(first) + " to " + text(first + 2),
                        text(got[first].begin) + " to " + text(got[first].end),
                        text(10 + first) + " to " + text(22 + first));
    report.guess({{"the end of the first cell: the run goes on to the end of the last",
                   [&] { return got[0].begin == 10 && got[0].end == 20; }},
                  {"the start of the last cell in place of its end",
                   [&] { return got[0].begin == 10 && got[0].end == 12; }}});
}

void before(Report& report) {
    auto hashes = uploaded(Device::cpu, eightBalls, "sortedHashes");
    for (const auto& [slot, first] : {std::pair{0, 0u}, {1, 1u}, {3, 3u}, {6, 5u}, {7, 9u}}) {
        const std::uint32_t got = firstCellStarting(slot, onHost(hashes));
        if (got != first)
            report.fail("first cell that slot " + text(slot) + " starts", text(got), text(first));
    }
    auto late = uploaded(Device::cpu, Hashes{9, 9}, "sortedHashes");
    if (const auto got = firstCellStarting(0, onHost(late)); got != 7)
        report.fail("first cell that slot 0 starts, alone in cell 9", text(got), "7");
    report.guess({{"its own cell alone: the plain version, with which a row cannot be read in two "
                   "loads",
                   [&] { return firstCellStarting(6, onHost(hashes)) == 7; }},
                  {"more than two cells: nobody asks from so far away",
                   [&] { return firstCellStarting(6, onHost(hashes)) == 4; }}});
}

void after(Report& report) {
    auto hashes = uploaded(Device::cpu, eightBalls, "sortedHashes");
    for (const auto& [slot, last] : {std::pair{0, 1u}, {2, 2u}, {5, 5u}, {6, 9u}, {7, 11u}}) {
        const std::uint32_t got = lastCellEnding(slot, 8, onHost(hashes), 12);
        if (got != last)
            report.fail("last cell that slot " + text(slot) + " ends", text(got), text(last));
    }
    auto early = uploaded(Device::cpu, Hashes{4, 4}, "sortedHashes");
    if (const auto got = lastCellEnding(1, 2, onHost(early), 12); got != 6)
        report.fail("last cell that slot 1 ends, in cell 4 of 12", text(got), "6");
    report.guess({{"its own cell alone: the plain version, with which a row cannot be read in two "
                   "loads",
                   [&] { return lastCellEnding(6, 8, onHost(hashes), 12) == 7; }},
                  {"past the last cell of the grid",
                   [&] { return lastCellEnding(7, 8, onHost(hashes), 12) > 11; }}});
}

void byHand(Report& report) {
    const CellBounds got = findCells(report.device, twelveCells, eightBalls);
    struct Row {
        std::uint32_t cell, start, end;
    };
    for (const Row& row : {Row{0, 0, 1}, {2, 1, 3}, {3, 3, 6}, {7, 6, 7}, {11, 7, 8}}) {
        if (got.starts[row.cell] != row.start)
            report.fail("start of cell " + text(row.cell), text(got.starts[row.cell]),
                        text(row.start));
        if (got.ends[row.cell] != row.end)
            report.fail("end of cell " + text(row.cell), text(got.ends[row.cell]), text(row.end));
    }
    guessMistake(report, eightBalls, got);
}

void oneCell(Report& report) {
    // All in the first, in a middle and in the last cell; a ball alone; two; no neighbours beside.
    for (const std::uint32_t cell : {0u, 5u, 11u})
        for (const std::size_t count : {1u, 2u, 300u}) {
            const Hashes hashes(count, cell);
            requireCells(report, hashes, findCells(report.device, twelveCells, hashes));
        }
    requireCells(report, {0, 0}, findCells(report.device, {1, 1, 1}, {0, 0}));
}

void segments(Report& report) {
    for (const int count : counts) {
        const Hashes hashes = randomHashes(count, 12 * 5 * 4, report.seed);
        const CellBounds got = findCells(report.device, {12, 5, 4}, hashes);
        std::vector<int> owners(hashes.size());
        for (std::uint32_t cell = 0; cell < got.starts.size(); ++cell) {
            for (std::uint32_t slot = got.starts[cell]; slot < got.ends[cell]; ++slot) {
                if (slot >= hashes.size()) {
                    report.fail("cell " + text(cell), "slot " + text(slot),
                                "slots below " + text(count));
                    break;
                }
                ++owners[slot];
                if (hashes[slot] != cell)
                    report.fail("slot " + text(slot) + ", whose hash is " + text(hashes[slot]),
                                "in cell " + text(cell), "in cell " + text(hashes[slot]));
            }
        }
        for (std::size_t slot = 0; slot < owners.size(); ++slot)
            if (owners[slot] != 1)
                report.fail("slot " + text(slot) + " of " + text(count),
                            "in " + text(owners[slot]) + " cells", "in one");
    }
}

/// All runs of `length` cells, read as a search does, against a count.
void requireRows(Report& report, UniformGrid& grid, const Hashes& hashes, int length) {
    const int rowCount = static_cast<int>(grid.cellCount()) - length + 1;
    DeviceBuffer<SlotRange> rows(report.device, static_cast<std::size_t>(rowCount), "rows");
    rows.fill(0);
    launch<readRow>(report.device, rowCount, grid.view(), length, rows.view());
    const std::vector<SlotRange> got = rows.download();
    bool stale = false;
    for (std::uint32_t first = 0; first < got.size(); ++first) {
        const auto last = first + static_cast<std::uint32_t>(length) - 1;
        const SlotRange expected = expectedRun(hashes, first, last);
        if (sameRun(got[first], expected)) continue;
        stale = stale || got[first].end > hashes.size();
        report.fail("cells " + text(first) + " to " + text(last), inWords(got[first]),
                    inWords(expected));
    }
    report.guess({{"cells that are not cleared: they hold the bounds of the frame before",
                   [&] { return stale; }}});
}

void rows(Report& report) {
    for (const int count : counts)
        for (const int length : {1, 2, 3}) {
            const Hashes hashes = randomHashes(count, 12 * 5 * 4, report.seed + 1);
            UniformGrid grid = staleGrid(report.device, {12, 5, 4});
            findCells(grid, hashes);
            requireRows(report, grid, hashes, length);
        }
}

void secondFrame(Report& report) {
    UniformGrid grid = staleGrid(report.device, {12, 5, 4});
    for (const int count : {1000, 100, 7, 0, 300}) {
        const Hashes hashes = randomHashes(count, 12 * 5 * 4, report.seed + 2);
        findCells(grid, hashes);
        for (const int length : {1, 3}) requireRows(report, grid, hashes, length);
    }
}

void layer(Report& report) {
    constexpr int side = 16;
    const Hashes hashes = randomHashes(400, side * side, report.seed + 3);
    UniformGrid grid = staleGrid(report.device, {side, 1, side});
    const CellBounds got = findCells(grid, hashes);
    requireCells(report, hashes, got);
    requireRows(report, grid, hashes, 1);
    if (report.failed()) report.picture([&] { return drawOccupancy(side, hashes, got); });

    const Hashes spread = randomHashes(1000, 1000, report.seed + 4);
    Hashes occupied = spread;
    occupied.erase(std::unique(occupied.begin(), occupied.end()), occupied.end());
    report.measured("1000 balls at random in 1000 cells leave " + text(1000 - occupied.size()) +
                    " of them empty");
}

void anyOrder(Report& report) {
    // Many balls a cell, so that threads of one cell work at the same time.
    const Hashes hashes = randomHashes(6000, 200, report.seed + 5);
    UniformGrid grid = staleGrid(report.device, {20, 5, 2});
    const CellBounds got = inEveryOrder(report, [&] { return findCells(grid, hashes); });
    if (report.isRacy) guessMistake(report, hashes, got);
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "05",
        {{"bounds.clear", "Cleared, every cell starts above every slot and ends at 0",
          "Only occupied cells are written. All others must already say: nobody here.", clear},
         {"bounds.row", "Cells that follow each other are one run of slots",
          "x runs fastest in the hash, so three cells of a row need two loads and one loop.", row},
         {"bounds.before", "A first slot also starts the empty cells before it, at most two",
          "Who reads a row from an empty cell on is told where its balls begin.", before},
         {"bounds.after", "A last slot also ends the empty cells after it, at most two",
          "Who reads a row up to an empty cell is told where its balls end.", after},
         {"bounds.by_hand", "Eight balls in twelve cells: each occupied cell has its start and end",
          "The first slot has nobody before it and the last nobody after it: both still count.",
          byHand},
         {"bounds.one_cell", "All balls may be in one cell, and that cell the first or the last",
          "Then one slot starts and ends the only cell, and nothing is written past the arrays.",
          oneCell},
         {"bounds.segments", "Each slot is in exactly one cell, the one that its hash names",
          "A slot in no cell is a ball that nothing can hit; in two, it is hit twice.", segments},
         {"bounds.rows", "Up to three cells in a row give just the slots of their balls",
          "This is how chapter 06 reads the grid, empty cells included.", rows},
         {"bounds.second_frame", "With other balls in the same arrays, nothing of before is left",
          "The arrays live as long as the engine. A cell that is not cleared is haunted.",
          secondFrame},
         {"bounds.layer", "A layer of cells: every cell holds as many balls as are in it",
          "The picture shows which is wrong: a start, an end, or the clearing.", layer},
         {"bounds.order", "The result does not depend on the order of the threads",
          "If two slots write one cell, the later one wins, and no one knows which that is.",
          anyOrder}});
}
