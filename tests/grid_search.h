// The broad phase alone: a grid built from the pieces of chapters 02 to 06, and the pairs in it.
#pragma once

#include "chapters/06_broad_phase/built_grid.cuh"
#include "common/random.h"
#include "tests/support.h"

namespace ballpit::test {

inline Spheres randomSpheres(int count, Bounds box, float smallest, float largest,
                             std::uint64_t seed) {
    Random random(seed);
    Spheres spheres;
    for (int k = 0; k < count; ++k) {
        const Vec3 position = random.uniformIn(box);
        const float radius = smallest + (largest - smallest) * random.uniform(0, 1);
        spheres.add(position, {}, radius, 1.0f, 1.0f);
    }
    return spheres;
}

/// A grid built over spheres from the pieces of chapters 02 to 05, and what the search of chapter
/// 06 finds in it.
class GridSearch {
public:
    GridSearch(const Spheres& spheres, Bounds bounds, float cellSize, Device device,
               std::size_t capacity = 64)
        : device_(device),
          grid_(device, spheres, bounds, cellSize),
          list_(device, spheres.count(), capacity),
          scratch_(device, 0, "scratch") {
        find();
    }

    /// Every pair that was found, stored or not.
    std::size_t found() const { return list_.starts.download().back(); }
    std::uint32_t outside() { return grid_.outside(); }
    /// The stored pairs by slot, as they lie in the list.
    std::vector<Pair> stored() const {
        return list_.pairs.download(std::min(found(), list_.pairs.count()));
    }

    /// All pairs by body number, first < second, sorted. Pairs found twice are in it twice.
    std::vector<Pair> pairsByBody() {
        if (found() > list_.pairs.count()) {
            list_.pairs.resize(found());
            find();
        }
        const std::vector<std::uint32_t> ids = grid_.ids();
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
    void find() {
        findPairsGrid(device_, grid_.count(), grid_.view(), grid_.sortedHashes(), grid_.positions(),
                      list_, grid_.status(), scratch_);
    }

    Device device_;
    BuiltGrid grid_;
    PairList list_;
    Scratch scratch_;
};

/// What GridSearch finds, by body number.
inline std::vector<Pair> gridPairs(const Spheres& spheres, Bounds bounds, float cellSize,
                                   Device device) {
    return GridSearch(spheres, bounds, cellSize, device).pairsByBody();
}

}  // namespace ballpit::test
