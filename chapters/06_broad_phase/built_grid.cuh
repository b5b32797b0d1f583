// Balls in cell order and the grid over them, built by the pieces of chapters 02 to 05: what a
// broad phase searches.
#pragma once

#include "02_grid_hash/grid_hash.cuh"
#include "03_sort/sort.cuh"
#include "04_reorder/reorder.cuh"
#include "05_cell_bounds/cell_bounds.cuh"
#include "common/rigid_body.cuh"

namespace ballpit {

class BuiltGrid {
public:
    BuiltGrid(Device device, const Spheres& spheres, Bounds bounds, float cellSize)
        : count_(static_cast<int>(spheres.count())),
          bodies_(device, spheres.count()),
          grid_(device, bounds, cellSize, count_),
          status_(device, 1, "status"),
          scratch_(device, 0, "scratch") {
        bodies_.upload(spheres);
        build();
    }

    /// Everything again, from the bodies as they came.
    void build() {
        const Device device = bodies_.device();
        const View<const std::uint32_t> sortedHashes = grid_.sortedHashes.view();
        status_.fill(0);
        launch<computeGridHash>(device, count_, grid_.view(),
                                View<const Vec4>(bodies_.view(unsorted).positions),
                                grid_.hashes.view(), grid_.indices.view(), status_.view());
        sortByHash(device, count_, grid_, scratch_);
        launch<reorderData>(device, count_, View<const std::uint32_t>(grid_.sortedIndices.view()),
                            bodies_.view(unsorted), bodies_.view(sorted));
        clearCells(grid_);
        launch<findCellStart>(device, count_, count_, sortedHashes, grid_.view());
    }

    int count() const { return count_; }
    Int3 resolution() const { return grid_.resolution; }
    GridView view() { return grid_.view(); }
    View<const std::uint32_t> sortedHashes() { return grid_.sortedHashes.view(); }
    View<const Vec4> positions() { return bodies_.view(sorted).positions; }
    /// What the kernels report: bodies outside, and pairs once a search has run.
    View<StepStatus> status() { return status_.view(); }
    std::uint32_t outside() const { return status_.download()[0].outside; }

    /// Which ball lies in each slot.
    std::vector<std::uint32_t> ids() { return bodies_.idsInMemoryOrder(sorted); }
    /// The cell of each slot.
    std::vector<std::uint32_t> hashes() const { return grid_.sortedHashes.download(); }

private:
    static constexpr RigidBodySystem::Copies unsorted{0, 0}, sorted{1, 1};

    int count_;
    RigidBodySystem bodies_;
    UniformGrid grid_;
    DeviceBuffer<StepStatus> status_;
    Scratch scratch_;
};

}  // namespace ballpit
