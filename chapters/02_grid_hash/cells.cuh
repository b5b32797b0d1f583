// The chapter's world and balls, and their cells: one launch of computeGridHash.
#pragma once

#include "02_grid_hash/grid_hash.cuh"
#include "common/coloring.h"
#include "common/launch.cuh"
#include "common/random.h"
#include "common/spheres.h"

namespace ballpit {

constexpr Bounds world{{-4, -3, -2}, {4, 3, 2}};
constexpr float cellSize = 2, ballRadius = 0.15f;

/// The eight balls of the lesson, then random ones.
inline Spheres makeBalls(int count, std::uint64_t seed) {
    const std::vector<Vec3> lesson{{-3, -2, -1}, {-0.5f, -2, -1}, {0.5f, -2, -1}, {3, 2, -1},
                                   {1, 0, 1},    {1.5f, 0.5f, 1}, {3, 2, 1},      {-5, 0, 1}};
    Random random(seed);
    Spheres balls;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
        balls.add(k < lesson.size() ? lesson[k] : random.uniformIn(world), {}, ballRadius, 1, 1);
    return balls;
}

class HashedBalls {
public:
    HashedBalls(Device device, int count)
        : device_(device),
          grid_(device, world, cellSize, count),
          positions_(device, static_cast<std::size_t>(count), "positions"),
          status_(device, 1, "status") {}

    void place(const Spheres& balls) {
        std::vector<Vec4> packed;
        for (const Vec3 position : balls.positions) packed.push_back(withW(position, ballRadius));
        positions_.upload(packed);
        status_.fill(0);
        hashAll();
    }

    void hashAll() {
        launch<computeGridHash>(device_, static_cast<int>(positions_.count()), grid_.view(),
                                View<const Vec4>(positions_.view()), grid_.hashes.view(),
                                grid_.indices.view(), status_.view());
    }

    std::int64_t cellCount() const { return static_cast<std::int64_t>(grid_.cellCount()); }
    std::int64_t outside() const { return status_.download()[0].outside; }
    std::vector<std::uint32_t> hashes() const { return grid_.hashes.download(); }

    /// Each ball in the colour of its cell; cells that touch have different ones.
    void color(Spheres& balls) const {
        const std::vector<std::uint32_t> cells = hashes();
        for (std::size_t k = 0; k < balls.count(); ++k)
            balls.colors[k] = cellColor(cellFromHash(grid_.resolution, cells[k]));
    }

private:
    Device device_;
    UniformGrid grid_;
    DeviceBuffer<Vec4> positions_;
    DeviceBuffer<StepStatus> status_;
};

}  // namespace ballpit
