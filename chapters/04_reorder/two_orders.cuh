// The same balls in two memory orders, as they came and by cell, and a search that reads them.
#pragma once

#include "01_naive_collision/naive_collision.cuh"
#include "02_grid_hash/grid_hash.cuh"
#include "03_sort/sort.cuh"
#include "04_reorder/reorder.cuh"
#include "05_cell_bounds/cell_bounds.cuh"
#include "common/rigid_body.cuh"
#include "common/scene.h"

namespace ballpit {

/// How many balls touch the ball of slot i? Looks at all balls of the 27 cells around it. The k-th
/// ball in cell order lies in slot places[k].
HD inline void countTouching(int i, GridView grid, View<const std::uint32_t> places,
                             View<const Vec4> positions, View<std::uint32_t> counts) {
    const Vec4 mine = positions[i];
    const Int3 cell = clampToGrid(grid, cellOf(grid, xyz(mine)));
    const Int3 low = clampToGrid(grid, {cell.x - 1, cell.y - 1, cell.z - 1});
    const Int3 high = clampToGrid(grid, {cell.x + 1, cell.y + 1, cell.z + 1});
    std::uint32_t count = 0;
    //@show search
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y) {
            const SlotRange row = slotsOfRow(grid, cellHash(grid.resolution, {low.x, y, z}),
                                             cellHash(grid.resolution, {high.x, y, z}));
            for (std::uint32_t k = row.begin; k < row.end; ++k)
                if (spheresTouch(mine, positions[places[k]])) ++count;
        }
    //@end
    counts[i] = count - 1;  // it touches itself
}

/// Mean distance in m from the ball in one slot to the ball in the next.
inline double meanStep(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& ids) {
    double sum = 0.0;
    for (std::size_t slot = 1; slot < ids.size(); ++slot)
        sum += length(positions.at(ids[slot]) - positions.at(ids[slot - 1]));
    return sum / static_cast<double>(std::max<std::size_t>(2, ids.size()) - 1);
}

enum class MemoryOrder { asTheyCame, byCell };

/// Balls in both orders, and the grid over them.
class TwoOrders {
public:
    TwoOrders(Device device, const Scene& scene)
        : device_(device),
          count_(static_cast<int>(scene.spheres.count())),
          bodies_(device, scene.spheres.count()),
          grid_(device, scene.bounds, scene.cellSize, count_),
          inOrder_(device, scene.spheres.count(), "inOrder"),
          counts_(device, scene.spheres.count(), "counts"),
          status_(device, 1, "status"),
          scratch_(device, 0, "scratch") {
        bodies_.upload(scene.spheres);
        status_.fill(0);
        launch<numberBody>(device_, count_, inOrder_.view());
        launch<computeGridHash>(device_, count_, grid_.view(),
                                View<const Vec4>(view(MemoryOrder::asTheyCame).positions),
                                grid_.hashes.view(), grid_.indices.view(), status_.view());
        sortByHash(device_, count_, grid_, scratch_);
        clearCells(grid_);
        launch<findCellStart>(device_, count_, count_,
                              View<const std::uint32_t>(grid_.sortedHashes.view()), grid_.view());
        gather();
    }

    /// Moves the balls as they came into cell order.
    void gather() {
        launch<reorderData>(device_, count_, places(MemoryOrder::asTheyCame),
                            view(MemoryOrder::asTheyCame), view(MemoryOrder::byCell));
    }
    /// The same with balls that are in order already: the engine's case from the second step on.
    void gatherAgain() {
        launch<reorderData>(device_, count_, places(MemoryOrder::byCell), view(MemoryOrder::byCell),
                            bodies_.view({2, 2}));
    }

    /// Counts every ball's touching balls, by slot.
    void search(MemoryOrder order) {
        launch<countTouching>(device_, count_, grid_.view(), places(order),
                              View<const Vec4>(view(order).positions), counts_.view());
    }
    /// The same by body.
    std::vector<std::uint32_t> touching(MemoryOrder order) {
        search(order);
        DeviceBuffer<std::uint32_t> byBody(device_, counts_.count(), "byBody");
        launch<returnToBodies<std::uint32_t>>(
            device_, count_, View<const std::uint32_t>(view(order).ids),
            View<const std::uint32_t>(counts_.view()), byBody.view());
        return byBody.download();
    }

    /// All balls by body, out of the memory of one order.
    Spheres download(MemoryOrder order) {
        bodies_.commit(copies(order));
        return bodies_.download();
    }
    /// The ball in each slot.
    std::vector<std::uint32_t> ids(MemoryOrder order) {
        return bodies_.idsInMemoryOrder(copies(order));
    }
    /// The cell of each slot, by cell.
    std::vector<std::uint32_t> cells() const { return grid_.sortedHashes.download(); }

private:
    static RigidBodySystem::Copies copies(MemoryOrder order) {
        return order == MemoryOrder::byCell ? RigidBodySystem::Copies{1, 1}
                                            : RigidBodySystem::Copies{0, 0};
    }
    BodiesView view(MemoryOrder order) { return bodies_.view(copies(order)); }

    /// Where the k-th ball in cell order lies.
    View<const std::uint32_t> places(MemoryOrder order) {
        return order == MemoryOrder::byCell ? inOrder_.view() : grid_.sortedIndices.view();
    }

    Device device_;
    int count_;
    RigidBodySystem bodies_;
    UniformGrid grid_;
    DeviceBuffer<std::uint32_t> inOrder_, counts_;
    DeviceBuffer<StepStatus> status_;
    Scratch scratch_;
};

}  // namespace ballpit
