// Balls sorted into cells, and the question that every search begins with: who is around me?
#pragma once

#include "02_grid_hash/grid_hash.cuh"
#include "03_sort/sort.cuh"
#include "05_cell_bounds/cell_bounds.cuh"
#include "common/rigid_body.cuh"
#include "common/scene.h"

namespace ballpit {

HD inline std::uint32_t lengthOf(SlotRange run) {
    return run.begin < run.end ? run.end - run.begin : 0u;
}

/// How many balls are in the 27 cells around slot i, itself included? By rows: two loads for three
/// cells. By cells: two loads for each.
template <bool byRows>
HD void countAround(int i, GridView grid, View<const std::uint32_t> sortedHashes,
                    View<std::uint32_t> counts) {
    const Int3 cell = cellFromHash(grid.resolution, sortedHashes[i]);
    const Int3 low = clampToGrid(grid, {cell.x - 1, cell.y - 1, cell.z - 1});
    const Int3 high = clampToGrid(grid, {cell.x + 1, cell.y + 1, cell.z + 1});
    std::uint32_t count = 0;
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y) {
            const std::uint32_t first = cellHash(grid.resolution, {low.x, y, z});
            const std::uint32_t last = cellHash(grid.resolution, {high.x, y, z});
            //@show loads
            if constexpr (byRows)
                count += lengthOf(slotsOfRow(grid, first, last));
            else
                for (std::uint32_t one = first; one <= last; ++one)
                    count += lengthOf(slotsOfRow(grid, one, one));
            //@end
        }
    counts[i] = count;
}

class Population {
public:
    Population(Device device, const Scene& scene)
        : device_(device),
          count_(static_cast<int>(scene.spheres.count())),
          bodies_(device, scene.spheres.count()),
          grid_(device, scene.bounds, scene.cellSize, count_),
          counts_(device, scene.spheres.count(), "counts"),
          status_(device, 1, "status"),
          scratch_(device, 0, "scratch") {
        bodies_.upload(scene.spheres);
        status_.fill(0);
        launch<computeGridHash>(device_, count_, grid_.view(),
                                View<const Vec4>(bodies_.view(bodies_.state()).positions),
                                grid_.hashes.view(), grid_.indices.view(), status_.view());
        sortByHash(device_, count_, grid_, scratch_);
        build();
    }

    /// What this chapter is about: the bounds of all cells.
    void build() {
        clearCells(grid_);
        launch<findCellStart>(device_, count_, count_, sortedHashes(), grid_.view());
    }

    template <bool byRows>
    void search() {
        launch<countAround<byRows>>(device_, count_, grid_.view(), sortedHashes(), counts_.view());
    }
    /// The answers of the search, by slot.
    template <bool byRows>
    std::vector<std::uint32_t> around() {
        search<byRows>();
        return counts_.download();
    }

    std::vector<std::uint32_t> hashes() const { return grid_.sortedHashes.download(); }
    /// The ball in each slot.
    std::vector<std::uint32_t> balls() const { return grid_.sortedIndices.download(); }
    std::vector<std::uint32_t> starts() const { return grid_.cellStarts.download(); }
    std::vector<std::uint32_t> ends() const { return grid_.cellEnds.download(); }

private:
    View<const std::uint32_t> sortedHashes() { return grid_.sortedHashes.view(); }

    Device device_;
    int count_;
    RigidBodySystem bodies_;
    UniformGrid grid_;
    DeviceBuffer<std::uint32_t> counts_;
    DeviceBuffer<StepStatus> status_;
    Scratch scratch_;
};

}  // namespace ballpit
