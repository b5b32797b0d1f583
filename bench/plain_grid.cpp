// Counting sort into cells, then every cell against itself and 13 of its neighbours.
#include "bench/plain_grid.h"

#include <algorithm>

#include "common/device.h"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace ballpit {

namespace {

int threadNumber() {
#ifdef _OPENMP
    return omp_get_thread_num();
#else
    return 0;
#endif
}

}  // namespace

PlainGrid::PlainGrid(Bounds bounds, float cellSize)
    : bounds_(bounds),
      inverseCellSize_(1.0f / cellSize),
      pairs_(static_cast<std::size_t>(cpuThreadCount())) {
    const Vec3 cells = inverseCellSize_ * extent(bounds);
    resolution_ = {static_cast<int>(cells.x) + 1, static_cast<int>(cells.y) + 1,
                   static_cast<int>(cells.z) + 1};
}

int PlainGrid::cellOf(Vec3 position) const {
    const Vec3 cell = inverseCellSize_ * (position - bounds_.lower);
    return (static_cast<int>(cell.z) * resolution_.y + static_cast<int>(cell.y)) * resolution_.x +
           static_cast<int>(cell.x);
}

void PlainGrid::sortIntoCells(const std::vector<Vec3>& positions) {
    const int count = static_cast<int>(positions.size());
    cells_.resize(positions.size());
    bodies_.resize(positions.size());
    sorted_.resize(positions.size());
    starts_.assign(static_cast<std::size_t>(resolution_.x) * resolution_.y * resolution_.z + 1, 0);
#pragma omp parallel for schedule(static)
    for (int k = 0; k < count; ++k) cells_[k] = static_cast<std::uint32_t>(cellOf(positions[k]));
    for (const std::uint32_t cell : cells_) ++starts_[cell + 1];
    for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
    next_.assign(starts_.begin(), starts_.end() - 1);
    for (int k = 0; k < count; ++k) {
        const std::uint32_t slot = next_[cells_[k]]++;
        bodies_[slot] = static_cast<std::uint32_t>(k);
        sorted_[slot] = positions[k];
    }
}

void PlainGrid::searchRange(std::uint32_t slot, std::uint32_t begin, std::uint32_t end,
                            float reachSquared, std::vector<Pair>& pairs) const {
    const Vec3 mine = sorted_[slot];
    for (std::uint32_t other = begin; other < end; ++other) {
        if (lengthSquared(sorted_[other] - mine) < reachSquared)
            pairs.push_back({bodies_[slot], bodies_[other]});
    }
}

void PlainGrid::searchCell(int x, int y, int z, float reachSquared,
                           std::vector<Pair>& pairs) const {
    const auto row = [&](int ry, int rz) { return (rz * resolution_.y + ry) * resolution_.x; };
    const int left = std::max(x - 1, 0), right = std::min(x + 1, resolution_.x - 1);
    const std::uint32_t begin = starts_[row(y, z) + x], end = starts_[row(y, z) + x + 1];
    const std::uint32_t ownRowEnd = starts_[row(y, z) + right + 1];
    for (std::uint32_t slot = begin; slot < end; ++slot) {
        searchRange(slot, slot + 1, ownRowEnd, reachSquared, pairs);
        for (int dz = 0; dz <= 1; ++dz) {
            for (int dy = dz == 0 ? 1 : -1; dy <= 1; ++dy) {
                if (y + dy < 0 || y + dy >= resolution_.y || z + dz >= resolution_.z) continue;
                const int other = row(y + dy, z + dz);
                searchRange(slot, starts_[other + left], starts_[other + right + 1], reachSquared,
                            pairs);
            }
        }
    }
}

std::size_t PlainGrid::findPairs(const std::vector<Vec3>& positions, float radius) {
    sortIntoCells(positions);
    for (auto& pairs : pairs_) pairs.clear();
    const float reachSquared = 4.0f * radius * radius;
#pragma omp parallel for schedule(static)
    for (int z = 0; z < resolution_.z; ++z)
        for (int y = 0; y < resolution_.y; ++y)
            for (int x = 0; x < resolution_.x; ++x)
                searchCell(x, y, z, reachSquared, pairs_[static_cast<std::size_t>(threadNumber())]);
    std::size_t found = 0;
    for (const auto& pairs : pairs_) found += pairs.size();
    return found;
}

}  // namespace ballpit
