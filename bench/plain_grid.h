// The yardstick: the pair search that a good programmer writes for a CPU in an afternoon.
#pragma once

#include <cstdint>
#include <vector>

#include "common/pair_list.cuh"
#include "common/spheres.h"

namespace ballpit {

/// A counting-sort grid for equal balls on the CPU, with its buffers kept between calls.
class PlainGrid {
public:
    /// Cells of edge `cellSize` (m, at least a diameter) over `bounds`.
    PlainGrid(Bounds bounds, float cellSize);

    /// Finds all touching pairs, as body numbers, and returns how many there are.
    std::size_t findPairs(const std::vector<Vec3>& positions, float radius);

    /// The pairs of the last call, one list a thread.
    const std::vector<std::vector<Pair>>& pairs() const { return pairs_; }

private:
    int cellOf(Vec3 position) const;
    void sortIntoCells(const std::vector<Vec3>& positions);
    void searchCell(int x, int y, int z, float reachSquared, std::vector<Pair>& pairs) const;
    void searchRange(std::uint32_t slot, std::uint32_t begin, std::uint32_t end, float reachSquared,
                     std::vector<Pair>& pairs) const;

    Bounds bounds_;
    float inverseCellSize_;
    Int3 resolution_;
    std::vector<std::uint32_t> cells_, starts_, next_, bodies_;
    std::vector<Vec3> sorted_;
    std::vector<std::vector<Pair>> pairs_;
};

}  // namespace ballpit
