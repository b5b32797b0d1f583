// Chapter 05: where each cell starts and ends in the sorted bodies.
#pragma once

#include "common/uniform_grid.cuh"

namespace ballpit {

/// Cleared value of cellStarts; cellEnds are cleared to 0. Cell c holds the slots from
/// cellStarts[c] to cellEnds[c] - 1, and none if the start is not below the end.
constexpr std::uint32_t noStart = 0xFFFFFFFFu;

/// How far an occupied cell answers for empty ones beside it. Three cells of a row are searched at
/// once, so the first of the three must know the start of the third, and the third the end of the
/// first: two cells.
constexpr std::uint32_t answersFor = 2;

/// Slot i starts a cell if its hash differs from the slot before, and ends one if it differs from
/// the slot after. It then writes its cell, and the empty cells up to two before (starts) or after
/// (ends): whoever asks those is told where the bodies go on, so a row is read with two loads.
HD inline void findCellStart(int i, int count, View<const std::uint32_t> sortedHashes,
                             GridView grid) {
    const std::uint32_t hash = sortedHashes[i];
    const auto slot = static_cast<std::uint32_t>(i);

    if (i == 0 || sortedHashes[i - 1] != hash) {
        const std::uint32_t firstEmpty = i == 0 ? 0u : sortedHashes[i - 1] + 1u;
        for (std::uint32_t cell = hash; cell + answersFor >= hash && cell >= firstEmpty; --cell) {
            grid.cellStarts[cell] = slot;
            if (cell == 0) break;
        }
    }
    if (i == count - 1 || sortedHashes[i + 1] != hash) {
        const std::uint32_t next = i == count - 1 ? grid.cellEnds.count : sortedHashes[i + 1];
        for (std::uint32_t cell = hash; cell <= hash + answersFor && cell < next; ++cell)
            grid.cellEnds[cell] = slot + 1u;
    }
}

/// A run of slots.
struct SlotRange {
    std::uint32_t begin, end;
};

/// The slots of cells first..last of one row, at most three cells. They are one run, because x is
/// the fastest part of the hash. Where all are empty, begin is not below end.
HD inline SlotRange slotsOfRow(const GridView& grid, std::uint32_t first, std::uint32_t last) {
    return {grid.cellStarts[first], grid.cellEnds[last]};
}

}  // namespace ballpit
