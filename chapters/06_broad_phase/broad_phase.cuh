// Chapter 06: all touching pairs from the 27 cells around each body; none missed, none twice.
//
// Each pair is found by the body that comes first in memory. Bodies lie in cell order, so the
// partners after body i are in the rest of its own row and in the four rows with higher hashes:
// 14 of the 27 cells. Count, scan, fill: every body counts its partners, a scan turns the counts
// into places, and every body writes its own pairs there. The list is the same on every run.
#pragma once

#include "01_naive_collision/naive_collision.cuh"
#include "02_grid_hash/grid_hash.cuh"
#include "05_cell_bounds/cell_bounds.cuh"
#include "common/algorithms.h"
#include "common/bodies.cuh"
#include "common/hole.cuh"
#include "common/launch.cuh"
#include "common/pair_list.cuh"

namespace ballpit {

/// The slots of up to three cells: in the row that lies dy above and dz behind the one of `cell`,
/// those from its left neighbour to its right one. A cell beyond the world's edge does not exist;
/// nor does a row: then there are no slots. `dz` is 0 or 1.
HD inline SlotRange rowBeside(const GridView& grid, Int3 cell, int dy, int dz) {
    // ---- hole pairs.row (about 6 lines): The slots of three cells of a row; mind the edges
    TODO_HOLE("pairs.row");
    return {0, 0};
    // ---- end of pairs.row
}

/// The runs of slots in which body i finds the partners after it, in rising order.
struct SearchRanges {
    SlotRange rows[5];
};

/// The rest of the own row, the next row of this layer (dy = 1), and three rows of the next layer
/// (dz = 1). The cell is the one body i was sorted into, taken from its hash, so that bodies may
/// have moved since: all partners are found as long as no body has moved farther than half a cell
/// less its radius. All five are fetched before any is searched, since memory answers late.
HD inline SearchRanges rangesAfter(int i, const GridView& grid,
                                   View<const std::uint32_t> sortedHashes) {
    const std::uint32_t hash = sortedHashes[i];
    const Int3 cell = cellFromHash(grid.resolution, hash);
    // ---- hole pairs.ranges (about 4 lines): The rest of its own row, and four rows
    TODO_HOLE("pairs.ranges");
    return {};
    // ---- end of pairs.ranges
}

/// Calls visit(j) for every slot j after i whose body touches body i, in rising order.
template <class Visit>
HD void visitPartnersAfter(int i, const GridView& grid, View<const std::uint32_t> sortedHashes,
                           View<const Vec4> positions, Visit visit) {
    const SearchRanges ranges = rangesAfter(i, grid, sortedHashes);
    const Vec4 mine = positions[i];
    // ---- hole pairs.visit (about 3 lines): Visit the slots whose body touches mine
    TODO_HOLE("pairs.visit");
    // ---- end of pairs.visit
}

/// Counts the partners of body i that come after it, and remembers the first few of them: those of
/// body i have places i * rememberedPartners and following.
HD inline void broadPhaseCollision(int i, GridView grid, View<const std::uint32_t> sortedHashes,
                                   View<const Vec4> positions, View<std::uint32_t> counts,
                                   View<std::uint32_t> remembered) {
    std::uint32_t count = 0;
    const std::size_t first = static_cast<std::size_t>(i) * rememberedPartners;
    // ---- hole pairs.count (about 5 lines): Count every partner, remember the first few
    TODO_HOLE("pairs.count");
    counts[i] = count;
    // ---- end of pairs.count
}

/// Tells the host how many pairs a round found: the first round's, and the most of any round. The
/// host compares that with the places there were.
HD inline void reportPairs(std::uint32_t found, StepStatus& status) {
    // ---- hole pairs.report (about 3 lines): How many pairs: the first round, the largest
    TODO_HOLE("pairs.report");
    // ---- end of pairs.report
}

/// Writes the pairs of body i to its places in the list: from memory, or by a second search where
/// there were too many to remember. Places past the capacity are counted but not written. Body 0
/// also reports how many pairs there are.
HD inline void writePairs(int i, GridView grid, View<const std::uint32_t> sortedHashes,
                          View<const Vec4> positions, View<const std::uint32_t> counts,
                          View<const std::uint32_t> remembered, PairsView list,
                          View<StepStatus> status) {
    if (i == 0) reportPairs(list.starts[counts.count], status[0]);
    std::uint32_t place = list.starts[i];
    if (list.starts[i + 1] < place) status[0].pairsUncountable = 1;  // the scan ran past 2^32
    // ---- hole pairs.write (about 8 lines): Write each pair to its place, if there is one
    TODO_HOLE("pairs.write");
    // ---- end of pairs.write
}

/// Fills `list` with all touching pairs of `count` bodies in the built grid.
inline void findPairsGrid(Device device, int count, GridView grid,
                          View<const std::uint32_t> sortedHashes, View<const Vec4> positions,
                          PairList& list, View<StepStatus> status, Scratch& scratch) {
    const View<std::uint32_t> counts = list.counts.view(), remembered = list.remembered.view();
    // ---- hole pairs.find (about 4 lines): Count, scan, fill: three calls
    TODO_HOLE("pairs.find");
    // ---- end of pairs.find
}

}  // namespace ballpit
