// The uniform grid: cells over the world, and which slots of the sorted bodies lie in each.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "common/buffer.cuh"
#include "common/error.h"
#include "common/vec3.cuh"

namespace ballpit {

/// The grid as kernels see it.
struct GridView {
    Vec3 origin;                     ///< the world's lower corner, m
    float inverseCellSize;           ///< 1/m
    Int3 resolution;                 ///< cells along x, y, z
    View<std::uint32_t> cellStarts;  ///< first slot of each cell
    View<std::uint32_t> cellEnds;    ///< one past its last slot; empty if not above its start
};

/// Cells over `bounds`, and the arrays that the build of the grid fills.
class UniformGrid {
public:
    /// `cellSize` in m. InputError if the grid would have more cells than can be numbered or
    /// than memory for them is reasonable.
    UniformGrid(Device device, Bounds bounds, float cellSize, int bodyCount)
        : cellSize(cellSize),
          resolution(resolutionFor(bounds, cellSize)),
          cellStarts(device, cellCount(), "cellStarts"),
          cellEnds(device, cellCount(), "cellEnds"),
          hashes(device, static_cast<std::size_t>(bodyCount), "hashes"),
          sortedHashes(device, static_cast<std::size_t>(bodyCount), "sortedHashes"),
          indices(device, static_cast<std::size_t>(bodyCount), "indices"),
          sortedIndices(device, static_cast<std::size_t>(bodyCount), "sortedIndices"),
          origin_(bounds.lower) {}

    GridView view() {
        return {origin_, 1.0f / hairLarger(cellSize, resolution), resolution, cellStarts.view(),
                cellEnds.view()};
    }

    std::size_t cellCount() const {
        return static_cast<std::size_t>(resolution.x) * static_cast<std::size_t>(resolution.y) *
               static_cast<std::size_t>(resolution.z);
    }

    /// The bits a sort must look at.
    int hashBits() const { return std::max(1, static_cast<int>(std::bit_width(cellCount() - 1))); }

    /// Device bytes of a grid before it is built.
    static std::size_t predictedBytes(Bounds bounds, float cellSize, std::size_t bodyCount) {
        const Int3 r = resolutionFor(bounds, cellSize);
        return 2 * sizeof(std::uint32_t) * static_cast<std::size_t>(r.x) *
                   static_cast<std::size_t>(r.y) * static_cast<std::size_t>(r.z) +
               4 * sizeof(std::uint32_t) * bodyCount;
    }
    std::size_t bytes() const {
        return cellStarts.bytes() + cellEnds.bytes() + hashes.bytes() + sortedHashes.bytes() +
               indices.bytes() + sortedIndices.bytes();
    }

    float cellSize;
    Int3 resolution;
    DeviceBuffer<std::uint32_t> cellStarts, cellEnds;
    DeviceBuffer<std::uint32_t> hashes, sortedHashes;
    DeviceBuffer<std::uint32_t> indices, sortedIndices;

private:
    /// Cells are made a hair larger than asked. A coordinate of up to R cells carries a rounding
    /// error of about R * 2^-22 cells; without the hair two balls that touch across a cell could
    /// be put two cells apart, and the pair missed.
    static float hairLarger(float cellSize, Int3 resolution) {
        const int longest = std::max({resolution.x, resolution.y, resolution.z});
        return cellSize * (1.0f + static_cast<float>(longest + 1) * 0x1p-20f);
    }

    static Int3 resolutionFor(Bounds bounds, float cellSize) {
        const Vec3 size = extent(bounds);
        const auto cells = [&](float length) {
            return std::max(1.0, std::ceil(static_cast<double>(length) / cellSize));
        };
        const double x = cells(size.x), y = cells(size.y), z = cells(size.z);
        constexpr double most = 1u << 30;
        if (!(x * y * z <= most)) {
            const double fits = std::cbrt(double(size.x) * size.y * size.z / most) * 1.01;
            throw InputError("cell size " + std::to_string(cellSize) +
                             " m makes too many cells for this world: at least " +
                             std::to_string(fits) + " m is needed");
        }
        return {static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
    }

    Vec3 origin_;
};

}  // namespace ballpit
