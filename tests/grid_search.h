// The broad phase alone: a grid built from the pieces of chapters 02 to 06, and the pairs in it.
#pragma once

#include "tests/support.h"

namespace ballpit::test {

/// A grid built over spheres from the pieces of chapters 02 to 06, and what the search in it found.
class GridSearch {
public:
    GridSearch(const Spheres& spheres, Bounds bounds, float cellSize, Device device,
               std::size_t capacity = 64)
        : count_(static_cast<int>(spheres.count())),
          bodies_(device, spheres.count()),
          grid_(device, bounds, cellSize, count_),
          list_(device, spheres.count(), capacity),
          status_(device, 1, "status"),
          scratch_(device, 0, "scratch") {
        bodies_.upload(spheres);
        build(device);
        find(device);
    }

    /// Every pair that was found, stored or not.
    std::size_t found() const { return list_.starts.download().back(); }
    std::uint32_t outside() const { return status_.download()[0].outside; }
    /// The stored pairs by slot, as they lie in the list.
    std::vector<Pair> stored() const {
        return list_.pairs.download(std::min(found(), list_.pairs.count()));
    }

    /// All pairs by body number, first < second, sorted. Pairs found twice are in it twice.
    std::vector<Pair> pairsByBody() {
        if (found() > list_.pairs.count()) {
            list_.pairs.resize(found());
            find(bodies_.device());
        }
        const std::vector<std::uint32_t> ids = bodies_.idsInMemoryOrder();
        std::vector<Pair> pairs = stored();
        for (Pair& pair : pairs) {
            if (pair.first >= pair.second) throw std::logic_error("a pair in the wrong order");
            pair = {std::min(ids[pair.first], ids[pair.second]),
                    std::max(ids[pair.first], ids[pair.second])};
        }
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }

private:
    void build(Device device) {
        const RigidBodySystem::Copies unsorted = bodies_.state(), sorted{1, 1};
        launch<clearStatus>(device, 1, status_.view());
        launch<computeGridHash>(device, count_, grid_.view(),
                                View<const Vec4>(bodies_.view(unsorted).positions),
                                grid_.hashes.view(), grid_.indices.view(), status_.view());
        sortByHash(device, count_, grid_, scratch_);
        launch<reorderData>(device, count_, View<const std::uint32_t>(grid_.sortedIndices.view()),
                            bodies_.view(unsorted), bodies_.view(sorted));
        clearCells(grid_);
        launch<findCellStart>(device, count_, count_,
                              View<const std::uint32_t>(grid_.sortedHashes.view()), grid_.view());
        bodies_.commit(sorted);
    }
    void find(Device device) {
        findPairsGrid(device, count_, grid_.view(), grid_.sortedHashes.view(),
                      bodies_.view(bodies_.state()).positions, list_, status_.view(), scratch_);
    }

    int count_;
    RigidBodySystem bodies_;
    UniformGrid grid_;
    PairList list_;
    DeviceBuffer<StepStatus> status_;
    Scratch scratch_;
};

/// What GridSearch finds, by body number.
inline std::vector<Pair> gridPairs(const Spheres& spheres, Bounds bounds, float cellSize,
                                   Device device) {
    return GridSearch(spheres, bounds, cellSize, device).pairsByBody();
}

}  // namespace ballpit::test
