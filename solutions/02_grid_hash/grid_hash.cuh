// Chapter 02: from a position to the number of the cell it lies in.
#pragma once

#include <cmath>

#include "common/atomics.cuh"
#include "common/bodies.cuh"
//@starter #include "common/hole.cuh"
#include "common/uniform_grid.cuh"

namespace ballpit {

/// Which cell along one axis? 0 to resolution - 1 in the grid, -1 below it, `resolution` above it.
/// A coordinate on a face belongs to the cell above; NaN gives -1. `coordinate` and `origin` in m.
HD inline int cellAlongAxis(float coordinate, float origin, float inverseCellSize, int resolution) {
    //@hole hash.axis lines=3 "The cell along one axis, or -1, or resolution"
    //@starter TODO_HOLE("hash.axis");
    //@starter return 0;
    // Not a cast: that rounds -0.5 up, into the grid.
    const float cell = floorf((coordinate - origin) * inverseCellSize);
    const float below = -1.0f, above = static_cast<float>(resolution);
    // Clamped while still a float: converting a float that no int can hold is undefined.
    return static_cast<int>(cell > below ? minimum(cell, above) : below);
    //@end
}

//@show cell_of
/// The cell of a position; one step outside the grid for positions outside of it.
HD inline Int3 cellOf(const GridView& grid, Vec3 position) {
    return {cellAlongAxis(position.x, grid.origin.x, grid.inverseCellSize, grid.resolution.x),
            cellAlongAxis(position.y, grid.origin.y, grid.inverseCellSize, grid.resolution.y),
            cellAlongAxis(position.z, grid.origin.z, grid.inverseCellSize, grid.resolution.z)};
}
//@end

/// The nearest of the indices 0 to count - 1.
HD inline int clampIndex(int i, int count) {
    //@hole hash.clamp lines=1 "The nearest index that exists"
    //@starter TODO_HOLE("hash.clamp");
    //@starter return 0;
    return i < 0 ? 0 : i < count ? i : count - 1;
    //@end
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
    //@hole hash.number lines=1 "Cell coordinates to one number: x runs fastest, z slowest"
    //@starter TODO_HOLE("hash.number");
    //@starter return 0;
    return static_cast<std::uint32_t>((cell.z * resolution.y + cell.y) * resolution.x + cell.x);
    //@end
}

/// The inverse of cellHash.
HD inline Int3 cellFromHash(Int3 resolution, std::uint32_t hash) {
    //@hole hash.inverse lines=4 "Back from the number to the cell, with / and %"
    //@starter TODO_HOLE("hash.inverse");
    //@starter return {0, 0, 0};
    const auto rowLength = static_cast<std::uint32_t>(resolution.x);
    const auto rowCount = static_cast<std::uint32_t>(resolution.y);
    const std::uint32_t row = hash / rowLength;
    return {static_cast<int>(hash % rowLength), static_cast<int>(row % rowCount),
            static_cast<int>(row / rowCount)};
    //@end
}

/// Which cell is body i in? Writes the cell's hash and the body's own slot, which the sort will
/// carry along. Bodies outside the grid get the nearest cell and are counted.
HD inline void computeGridHash(int i, GridView grid, View<const Vec4> positions,
                               View<std::uint32_t> hashes, View<std::uint32_t> indices,
                               View<StepStatus> status) {
    //@hole hash.write lines=5 "Write body i's hash and slot; count it if it is outside"
    //@starter TODO_HOLE("hash.write");
    const Int3 cell = cellOf(grid, xyz(positions[i]));
    const Int3 clamped = clampToGrid(grid, cell);
    if (!isSameCell(cell, clamped)) fetchAdd(status[0].outside, 1);
    hashes[i] = cellHash(grid.resolution, clamped);
    indices[i] = static_cast<std::uint32_t>(i);
    //@end
}

}  // namespace ballpit
