// Balls on a table, and the search for those that touch, with a list that is as long as it must be.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "01_naive_collision/naive_collision.cuh"
#include "common/random.h"
#include "common/spheres.h"

namespace ballpit {

/// 5 m^2 of table for each ball, so that more balls are not more crowded. All centres at y = 0.
inline Bounds tableFor(int count) {
    const float half = std::sqrt(5.0f * static_cast<float>(count)) / 2;
    return {{-half, 0, -half}, {half, 0, half}};
}

inline Spheres scatterBalls(int count, std::uint64_t seed) {
    Random random(seed);
    Spheres spheres;
    for (int k = 0; k < count; ++k) {
        const Vec3 place = random.uniformIn(tableFor(count));
        spheres.add(place, {}, random.uniform(0.3f, 0.8f), 1.0f, 1.0f);
    }
    return spheres;
}

class TouchSearch {
public:
    TouchSearch(Device device, const Spheres& spheres)
        : device_(device),
          positions_(device, spheres.count(), "positions"),
          pairs_(device, 0, "pairs"),
          found_(device, 1, "found") {
        place(spheres);
    }

    void place(const Spheres& spheres) {
        std::vector<Vec4> balls;
        for (std::size_t k = 0; k < spheres.count(); ++k)
            balls.push_back(withW(spheres.positions[k], spheres.radii[k]));
        positions_.upload(balls);
    }

    /// How many pairs touch. Of these, as many are listed as the list has room for.
    std::uint32_t search() {
        found_.fill(0);
        launchFindPairsNaive(device_, static_cast<int>(positions_.count()), positions_.view(),
                             pairs_.view(), found_.view());
        return found_.download()[0];
    }

    /// All pairs, sorted: threads append in any order.
    std::vector<Pair> pairs() {
        std::uint32_t found = search();
        if (found > pairs_.count()) {
            pairs_.resize(found);  // a full list says how long it must be
            found = search();
        }
        std::vector<Pair> list = pairs_.download(found);
        std::sort(list.begin(), list.end());
        return list;
    }

private:
    Device device_;
    DeviceBuffer<Vec4> positions_;
    DeviceBuffer<Pair> pairs_;
    DeviceBuffer<std::uint32_t> found_;
};

/// Red for balls that touch another.
inline void colorTouching(Spheres& spheres, const std::vector<Pair>& pairs) {
    spheres.colors.assign(spheres.count(), {0.7f, 0.7f, 0.7f});
    for (const auto [first, second] : pairs)
        spheres.colors.at(first) = spheres.colors.at(second) = {0.86f, 0.15f, 0.13f};
}

}  // namespace ballpit
