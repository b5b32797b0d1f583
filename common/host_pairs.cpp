// Sorted cell keys and binary search; nothing shared with the engine's grid.
#include "common/host_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ballpit {

namespace {

struct CellEntry {
    std::int64_t x, y, z;
    std::uint32_t body;

    bool operator<(const CellEntry& other) const {
        if (z != other.z) return z < other.z;
        if (y != other.y) return y < other.y;
        return x < other.x;
    }
};

bool touch(const Spheres& spheres, std::uint32_t a, std::uint32_t b) {
    const Vec3 p = spheres.positions[a], q = spheres.positions[b];
    const float dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z;
    const float reach = spheres.radii[a] + spheres.radii[b];
    return dx * dx + dy * dy + dz * dz < reach * reach;
}

std::vector<CellEntry> sortedCells(const Spheres& spheres) {
    float largest = 1e-6f;
    for (const float radius : spheres.radii) largest = std::max(largest, radius);
    const double cellSize = 2.0 * largest * (1.0 + 1e-6);
    // Clamped: what is 2^40 cells away has no neighbours that matter, and its number must fit.
    constexpr double farthest = 0x1p40;
    const auto along = [&](float c) {
        return std::llround(std::clamp(std::floor(c / cellSize), -farthest, farthest));
    };
    std::vector<CellEntry> cells;
    for (std::uint32_t k = 0; k < spheres.count(); ++k) {
        const Vec3 p = spheres.positions[k];
        if (isFinite(p)) cells.push_back({along(p.x), along(p.y), along(p.z), k});
    }
    std::sort(cells.begin(), cells.end());
    return cells;
}

}  // namespace

std::vector<Pair> findPairsOnHost(const Spheres& spheres) {
    const std::vector<CellEntry> cells = sortedCells(spheres);
    std::vector<Pair> pairs;
    for (const CellEntry& cell : cells) {
        for (int dz = -1; dz <= 1; ++dz) {
            for (int dy = -1; dy <= 1; ++dy) {
                const CellEntry first{cell.x - 1, cell.y + dy, cell.z + dz, 0};
                const CellEntry last{cell.x + 1, cell.y + dy, cell.z + dz, 0};
                auto other = std::lower_bound(cells.begin(), cells.end(), first);
                for (; other != cells.end() && !(last < *other); ++other)
                    if (cell.body < other->body && touch(spheres, cell.body, other->body))
                        pairs.push_back({cell.body, other->body});
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace ballpit
