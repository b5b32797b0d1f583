// Chapter 02: from a position to the number of the cell it lies in.
#pragma once

#include <cmath>

#include "common/atomics.cuh"
#include "common/bodies.cuh"
#include "common/hole.cuh"
#include "common/uniform_grid.cuh"

namespace ballpit {

/// Which cell along one axis? 0 to resolution - 1 in the grid, -1 below it, `resolution` above it.
/// A coordinate on a face belongs to the cell above; NaN gives -1. `coordinate` and `origin` in m.
HD inline int cellAlongAxis(float coordinate, float origin, float inverseCellSize, int resolution) {
    // ---- hole hash.axis (about 3 lines): The cell along one axis, or -1, or resolution
    TODO_HOLE("hash.axis");
    return 0;
    // ---- end of hash.axis
}

/// The cell of a position; one step outside the grid for positions outside of it.
HD inline Int3 cellOf(const GridView& grid, Vec3 position) {
    return {cellAlongAxis(position.x, grid.origin.x, grid.inverseCellSize, grid.resolution.x),
            cellAlongAxis(position.y, grid.origin.y, grid.inverseCellSize, grid.resolution.y),
            cellAlongAxis(position.z, grid.origin.z, grid.inverseCellSize, grid.resolution.z)};
}

/// The nearest of the indices 0 to count - 1.
HD inline int clampIndex(int i, int count) {
    // ---- hole hash.clamp (about 1 line): The nearest index that exists
    TODO_HOLE("hash.clamp");
    return 0;
    // ---- end of hash.clamp
}

/// The nearest cell of the grid. Clamping never moves two cells apart, so bodies outside the world
/// still meet all their neighbours.
HD inline Int3 clampToGrid(const GridView& grid, Int3 cell) {
    return {clampIndex(cell.x, grid.resolution.x), clampIndex(cell.y, grid.resolution.y),
            clampIndex(cell.z, grid.resolution.z)};
}

HD inline bool isSameCell(Int3 a, Int3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// 1-D number of a cell inside the grid: x runs fastest, so the cells of a row are neighbours.
HD inline std::uint32_t cellHash(Int3 resolution, Int3 cell) {
    // ---- hole hash.number (about 1 line): Cell coordinates to one number: x runs fastest, z slowest
    TODO_HOLE("hash.number");
    return 0;
    // ---- end of hash.number
}

/// The inverse of cellHash.
HD inline Int3 cellFromHash(Int3 resolution, std::uint32_t hash) {
    // ---- hole hash.inverse (about 4 lines): Back from the number to the cell, with / and %
    TODO_HOLE("hash.inverse");
    return {0, 0, 0};
    // ---- end of hash.inverse
}

/// Which cell is body i in? Writes the cell's hash and the body's own slot, which the sort will
/// carry along. Bodies outside the grid get the nearest cell and are counted.
HD inline void computeGridHash(int i, GridView grid, View<const Vec4> positions,
                               View<std::uint32_t> hashes, View<std::uint32_t> indices,
                               View<StepStatus> status) {
    // ---- hole hash.write (about 5 lines): Write body i's hash and slot; count it if it is outside
    TODO_HOLE("hash.write");
    // ---- end of hash.write
}

}  // namespace ballpit
