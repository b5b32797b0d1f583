// Sorted cell keys and binary search; nothing shared with the engine's grid.
#include "common/host_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/bodies.cuh"

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

bool touch(const Spheres& spheres, std::uint32_t a, std::uint32_t b, Vec3 period) {
    const Vec3 p = spheres.positions[a], q = spheres.positions[b];
    const float reach = spheres.radii[a] + spheres.radii[b];
    const Vec3 between = period.x > 0.0f ? toNearestImage(q - p, period) : q - p;
    return lengthSquared(between) < reach * reach;
}

double cellSizeFor(const Spheres& spheres) {
    float largest = 1e-6f;
    for (const float radius : spheres.radii) largest = std::max(largest, radius);
    return 2.0 * largest * (1.0 + 1e-6);
}

/// Calls visit(place) for p and its images in and just around the box.
template <class Visit>
void visitImages(Vec3 p, const Bounds& box, double margin, Visit visit) {
    const auto images = [&](float Vec3::*axis) {
        const float lower = box.lower.*axis, upper = box.upper.*axis, edge = upper - lower;
        std::vector<float> places;
        for (const float place : {p.*axis - edge, p.*axis, p.*axis + edge})
            if (place >= lower - margin && place <= upper + margin) places.push_back(place);
        return places;
    };
    for (const float x : images(&Vec3::x))
        for (const float y : images(&Vec3::y))
            for (const float z : images(&Vec3::z)) visit(Vec3{x, y, z});
}

std::vector<CellEntry> sortedCells(const Spheres& spheres, const std::optional<Bounds>& periodic) {
    const double cellSize = cellSizeFor(spheres);
    // Clamped: what is 2^40 cells away has no neighbours that matter, and its number must fit.
    constexpr double farthest = 0x1p40;
    const auto along = [&](float c) {
        return std::llround(std::clamp(std::floor(c / cellSize), -farthest, farthest));
    };
    std::vector<CellEntry> cells;
    for (std::uint32_t k = 0; k < spheres.count(); ++k) {
        const Vec3 position = spheres.positions[k];
        const auto add = [&](Vec3 p) {
            if (isFinite(p)) cells.push_back({along(p.x), along(p.y), along(p.z), k});
        };
        periodic ? visitImages(position, *periodic, cellSize, add) : add(position);
    }
    std::sort(cells.begin(), cells.end());
    return cells;
}

}  // namespace

std::vector<Pair> findPairsOnHost(const Spheres& spheres, const std::optional<Bounds>& periodic) {
    const std::vector<CellEntry> cells = sortedCells(spheres, periodic);
    const Vec3 period = periodic ? extent(*periodic) : Vec3{};
    std::vector<Pair> pairs;
    for (const CellEntry& cell : cells) {
        for (int dz = -1; dz <= 1; ++dz) {
            for (int dy = -1; dy <= 1; ++dy) {
                const CellEntry first{cell.x - 1, cell.y + dy, cell.z + dz, 0};
                const CellEntry last{cell.x + 1, cell.y + dy, cell.z + dz, 0};
                auto other = std::lower_bound(cells.begin(), cells.end(), first);
                for (; other != cells.end() && !(last < *other); ++other)
                    if (cell.body < other->body && touch(spheres, cell.body, other->body, period))
                        pairs.push_back({cell.body, other->body});
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    // Near a face a pair meets there and again at the image of that place.
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace ballpit
