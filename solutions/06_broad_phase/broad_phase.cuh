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
//@starter #include "common/hole.cuh"
#include "common/launch.cuh"
#include "common/pair_list.cuh"

namespace ballpit {

/// The slots of up to three cells: in the row that lies dy above and dz behind the one of `cell`,
/// those from its left neighbour to its right one. A cell beyond the world's edge does not exist;
/// nor does a row: then there are no slots. `dz` is 0 or 1.
HD inline SlotRange rowBeside(const GridView& grid, Int3 cell, int dy, int dz) {
    //@hole pairs.row lines=6 "The slots of three cells of a row; mind the edges"
    //@starter TODO_HOLE("pairs.row");
    //@starter return {0, 0};
    const Int3 there{cell.x, cell.y + dy, cell.z + dz};
    if (there.y < 0 || there.y >= grid.resolution.y || there.z >= grid.resolution.z) return {0, 0};
    const std::uint32_t middle = cellHash(grid.resolution, there);
    const std::uint32_t left = cell.x > 0 ? 1 : 0;
    const std::uint32_t right = cell.x + 1 < grid.resolution.x ? 1 : 0;
    return slotsOfRow(grid, middle - left, middle + right);
    //@end
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
    //@hole pairs.ranges lines=4 "The rest of its own row, and four rows"
    //@starter TODO_HOLE("pairs.ranges");
    //@starter return {};
    const std::uint32_t right = cell.x + 1 < grid.resolution.x ? 1 : 0;
    const SlotRange rest{static_cast<std::uint32_t>(i) + 1u, grid.cellEnds[hash + right]};
    return {{rest, rowBeside(grid, cell, 1, 0), rowBeside(grid, cell, -1, 1),
             rowBeside(grid, cell, 0, 1), rowBeside(grid, cell, 1, 1)}};
    //@end
}

/// Calls visit(j) for every slot j after i whose body touches body i, in rising order.
template <class Visit>
HD void visitPartnersAfter(int i, const GridView& grid, View<const std::uint32_t> sortedHashes,
                           View<const Vec4> positions, Visit visit) {
    const SearchRanges ranges = rangesAfter(i, grid, sortedHashes);
    const Vec4 mine = positions[i];
    //@hole pairs.visit lines=3 "Visit the slots whose body touches mine"
    //@starter TODO_HOLE("pairs.visit");
    for (const SlotRange& row : ranges.rows) {
        for (std::uint32_t j = row.begin; j < row.end; ++j) {
            if (spheresTouch(mine, positions[j])) visit(j);
        }
    }
    //@end
}

/// Counts the partners of body i that come after it, and remembers the first few of them: those of
/// body i have places i * rememberedPartners and following.
HD inline void broadPhaseCollision(int i, GridView grid, View<const std::uint32_t> sortedHashes,
                                   View<const Vec4> positions, View<std::uint32_t> counts,
                                   View<std::uint32_t> remembered) {
    std::uint32_t count = 0;
    const std::size_t first = static_cast<std::size_t>(i) * rememberedPartners;
    //@hole pairs.count lines=5 "Count every partner, remember the first few"
    //@starter TODO_HOLE("pairs.count");
    //@starter counts[i] = count;
    visitPartnersAfter(i, grid, sortedHashes, positions, [&](std::uint32_t j) {
        if (count < rememberedPartners) remembered[first + count] = j;
        ++count;
    });
    counts[i] = count;
    //@end
}

/// Tells the host how many pairs a round found: the first round's, and the most of any round. The
/// host compares that with the places there were.
HD inline void reportPairs(std::uint32_t found, StepStatus& status) {
    //@hole pairs.report lines=3 "How many pairs: the first round, the largest"
    //@starter TODO_HOLE("pairs.report");
    if (status.roundsDetected == 0) status.collisions = found;
    if (found > status.pairsNeeded) status.pairsNeeded = found;
    ++status.roundsDetected;
    //@end
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
    //@hole pairs.write lines=8 "Write each pair to its place, if there is one"
    //@starter TODO_HOLE("pairs.write");
    const auto write = [&](std::uint32_t j) {
        if (place < list.pairs.count) list.pairs[place] = {static_cast<std::uint32_t>(i), j};
        ++place;
    };
    if (counts[i] > rememberedPartners)
        return visitPartnersAfter(i, grid, sortedHashes, positions, write);
    const std::size_t first = static_cast<std::size_t>(i) * rememberedPartners;
    for (std::uint32_t k = 0; k < counts[i]; ++k) write(remembered[first + k]);
    //@end
}

/// Fills `list` with all touching pairs of `count` bodies in the built grid.
inline void findPairsGrid(Device device, int count, GridView grid,
                          View<const std::uint32_t> sortedHashes, View<const Vec4> positions,
                          PairList& list, View<StepStatus> status, Scratch& scratch) {
    const View<std::uint32_t> counts = list.counts.view(), remembered = list.remembered.view();
    //@hole pairs.find lines=4 "Count, scan, fill: three calls"
    //@starter TODO_HOLE("pairs.find");
    launch<broadPhaseCollision>(device, count, grid, sortedHashes, positions, counts, remembered);
    exclusiveScan(device, count, list.counts.data(), list.starts.data(), scratch);
    launch<writePairs>(device, count, grid, sortedHashes, positions, counts, remembered,
                       list.view(), status);
    //@end
}

}  // namespace ballpit
