// Chapter 05: where each cell starts and ends in the sorted bodies.
#pragma once

//@starter #include "common/hole.cuh"
#include "common/uniform_grid.cuh"

namespace ballpit {

/// Cleared value of cellStarts; cellEnds are cleared to 0. Cell c holds the slots from
/// cellStarts[c] to cellEnds[c] - 1, and none if the start is not below the end.
constexpr std::uint32_t noStart = 0xFFFFFFFFu;

/// Empties all cells, before findCellStart fills the occupied ones: a start above every end, an end
/// below every start. noStart is 0xFF in every byte, which a fill can write.
inline void clearCells(UniformGrid& grid) {
    //@hole bounds.clear lines=2 "Every start becomes noStart, every end 0"
    //@starter TODO_HOLE("bounds.clear");
    grid.cellStarts.fill(0xFF);
    grid.cellEnds.fill(0);
    //@end
}

/// How far an occupied cell answers for empty ones beside it. Three cells of a row are searched at
/// once, so the first of the three must know the start of the third, and the third the end of the
/// first: two cells.
constexpr std::uint32_t answersFor = 2;

/// Slot i is the first of its cell. Which is the first cell that has its start there? The empty
/// cells right before its own, at most two of them, are told where the bodies go on.
HD inline std::uint32_t firstCellStarting(int i, View<const std::uint32_t> sortedHashes) {
    //@hole bounds.before lines=3 "From which cell on, up to the slot's own, does slot i start cells?"
    //@starter TODO_HOLE("bounds.before");
    //@starter return sortedHashes[i];  // the plain version: its own cell alone
    const std::uint32_t hash = sortedHashes[i];
    const std::uint32_t firstEmpty = i == 0 ? 0u : sortedHashes[i - 1] + 1u;
    return hash > firstEmpty + answersFor ? hash - answersFor : firstEmpty;
    //@end
}

/// Slot i is the last of its cell. Which is the last cell that has its end there? The empty cells
/// right after its own, at most two of them, are told where the bodies stopped.
HD inline std::uint32_t lastCellEnding(int i, int count, View<const std::uint32_t> sortedHashes,
                                       std::uint32_t cellCount) {
    //@hole bounds.after lines=3 "Up to which cell, from the slot's own, does slot i end cells?"
    //@starter TODO_HOLE("bounds.after");
    //@starter return sortedHashes[i];  // the plain version: its own cell alone
    const std::uint32_t hash = sortedHashes[i];
    const std::uint32_t next = i == count - 1 ? cellCount : sortedHashes[i + 1];
    return next > hash + answersFor ? hash + answersFor : next - 1u;
    //@end
}

/// Slot i starts a cell if its hash differs from the slot before, and ends one if it differs from
/// the slot after. Only these slots write; every cell is written by one slot at most.
HD inline void findCellStart(int i, int count, View<const std::uint32_t> sortedHashes,
                             GridView grid) {
    const std::uint32_t hash = sortedHashes[i];
    const auto slot = static_cast<std::uint32_t>(i);
    //@hole bounds.start lines=3 "If slot i is the first of its cell, write the start"
    //@starter TODO_HOLE("bounds.start");
    if (i == 0 || sortedHashes[i - 1] != hash)
        for (std::uint32_t cell = firstCellStarting(i, sortedHashes); cell <= hash; ++cell)
            grid.cellStarts[cell] = slot;
    //@end
    //@hole bounds.end lines=4 "If slot i is the last of its cell, write the end: one past it"
    //@starter TODO_HOLE("bounds.end");
    if (i == count - 1 || sortedHashes[i + 1] != hash) {
        const std::uint32_t last = lastCellEnding(i, count, sortedHashes, grid.cellEnds.count);
        for (std::uint32_t cell = hash; cell <= last; ++cell) grid.cellEnds[cell] = slot + 1u;
    }
    //@end
}

/// A run of slots.
struct SlotRange {
    std::uint32_t begin, end;
};

/// The slots of cells first..last of one row, at most three cells. They are one run, because x is
/// the fastest part of the hash. Where all are empty, begin is not below end.
HD inline SlotRange slotsOfRow(const GridView& grid, std::uint32_t first, std::uint32_t last) {
    //@hole bounds.row lines=1 "The run of slots from the first cell's start to the last cell's end"
    //@starter TODO_HOLE("bounds.row");
    //@starter return {0, 0};
    return {grid.cellStarts[first], grid.cellEnds[last]};
    //@end
}

}  // namespace ballpit
