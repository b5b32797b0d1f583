// Chapter 05: where each cell starts and ends in the sorted bodies.
#pragma once

#include "common/hole.cuh"
#include "common/uniform_grid.cuh"

namespace ballpit {

/// Cleared value of cellStarts; cellEnds are cleared to 0. Cell c holds the slots from
/// cellStarts[c] to cellEnds[c] - 1, and none if the start is not below the end.
constexpr std::uint32_t noStart = 0xFFFFFFFFu;

/// Empties all cells, before findCellStart fills the occupied ones: a start above every end, an end
/// below every start. noStart is 0xFF in every byte, which a fill can write.
inline void clearCells(UniformGrid& grid) {
    // ---- hole bounds.clear (about 2 lines): Every start becomes noStart, every end 0
    TODO_HOLE("bounds.clear");
    // ---- end of bounds.clear
}

/// How far an occupied cell answers for empty ones beside it. Three cells of a row are searched at
/// once, so the first of the three must know the start of the third, and the third the end of the
/// first: two cells.
constexpr std::uint32_t answersFor = 2;

/// Slot i is the first of its cell. Which is the first cell that has its start there? The empty
/// cells right before its own, at most two of them, are told where the bodies go on.
HD inline std::uint32_t firstCellStarting(int i, View<const std::uint32_t> sortedHashes) {
    // ---- hole bounds.before (about 3 lines): From which cell on, up to the slot's own, does slot i start cells?
    TODO_HOLE("bounds.before");
    return sortedHashes[i];  // the plain version: its own cell alone
    // ---- end of bounds.before
}

/// Slot i is the last of its cell. Which is the last cell that has its end there? The empty cells
/// right after its own, at most two of them, are told where the bodies stopped.
HD inline std::uint32_t lastCellEnding(int i, int count, View<const std::uint32_t> sortedHashes,
                                       std::uint32_t cellCount) {
    // ---- hole bounds.after (about 3 lines): Up to which cell, from the slot's own, does slot i end cells?
    TODO_HOLE("bounds.after");
    return sortedHashes[i];  // the plain version: its own cell alone
    // ---- end of bounds.after
}

/// Slot i starts a cell if its hash differs from the slot before, and ends one if it differs from
/// the slot after. Only these slots write; every cell is written by one slot at most.
HD inline void findCellStart(int i, int count, View<const std::uint32_t> sortedHashes,
                             GridView grid) {
    const std::uint32_t hash = sortedHashes[i];
    const auto slot = static_cast<std::uint32_t>(i);
    // ---- hole bounds.start (about 3 lines): If slot i is the first of its cell, write the start
    TODO_HOLE("bounds.start");
    // ---- end of bounds.start
    // ---- hole bounds.end (about 4 lines): If slot i is the last of its cell, write the end: one past it
    TODO_HOLE("bounds.end");
    // ---- end of bounds.end
}

/// A run of slots.
struct SlotRange {
    std::uint32_t begin, end;
};

/// The slots of cells first..last of one row, at most three cells. They are one run, because x is
/// the fastest part of the hash. Where all are empty, begin is not below end.
HD inline SlotRange slotsOfRow(const GridView& grid, std::uint32_t first, std::uint32_t last) {
    // ---- hole bounds.row (about 1 line): The run of slots from the first cell's start to the last cell's end
    TODO_HOLE("bounds.row");
    return {0, 0};
    // ---- end of bounds.row
}

}  // namespace ballpit
