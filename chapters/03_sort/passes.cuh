// The chapter's film: the list of keys as rows of balls on a table; pass by pass every ball moves
// to its new slot.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "common/coloring.h"
#include "common/film.h"

namespace ballpit {

/// A colour for each eighth of the list.
inline void colorEighths(Spheres& spheres, const std::vector<std::uint32_t>& sorted) {
    const std::size_t eighth = sorted.size() / 8 + 1;
    for (std::size_t k = 0; k < sorted.size(); ++k)
        spheres.colors[sorted[k] % sorted.size()] = paletteColor(k / eighth);
}

/// A table with a place for each slot, row by row from the back.
struct Table {
    int columns, rows;

    explicit Table(int slots)
        : columns(static_cast<int>(std::ceil(std::sqrt(1.8 * slots)))),
          rows((slots + columns - 1) / columns) {}

    Vec3 place(std::size_t slot) const {
        const int k = static_cast<int>(slot);
        return {static_cast<float>(k % columns), 0.4f, static_cast<float>(k / columns)};
    }
    Bounds bounds() const {
        return {{-1, 0, -1}, {static_cast<float>(columns), 4, static_cast<float>(rows)}};
    }
};

/// `orderAfter(pass)`: which key lies in each slot then; pass 0 is before the first.
inline void showPasses(const Options& options, const std::vector<std::uint32_t>& keys, int passes,
                       const std::function<std::vector<std::uint32_t>(int)>& orderAfter) {
    const Table table(static_cast<int>(keys.size()));
    const auto largest = static_cast<float>(*std::max_element(keys.begin(), keys.end()));
    std::vector<std::vector<Vec3>> places;  // of each key, after each pass
    for (int pass = 0; pass <= passes; ++pass) {
        places.emplace_back(keys.size());
        const std::vector<std::uint32_t> order = orderAfter(pass);
        for (std::size_t slot = 0; slot < order.size(); ++slot)
            places.back().at(order[slot]) = table.place(slot);
    }
    Spheres balls;
    for (const std::uint32_t key : keys)
        balls.add({}, {}, 0.4f, 1, 1, rampColor(static_cast<float>(key) / largest));
    showMotion(options, table.bounds(), balls, [&](Spheres& shown, float share) {
        // Of each pass's time a quarter is rest before, a quarter after the move.
        const float time = share * static_cast<float>(passes);
        const int pass = std::min(passes - 1, static_cast<int>(time));
        const float way = std::clamp(2.0f * (time - static_cast<float>(pass)) - 0.5f, 0.0f, 1.0f);
        const float done = way * way * (3.0f - 2.0f * way);
        for (std::size_t k = 0; k < keys.size(); ++k) {
            const Vec3 from = places[static_cast<std::size_t>(pass)][k];
            const Vec3 to = places[static_cast<std::size_t>(pass) + 1][k];
            const float hop = std::sin(std::numbers::pi_v<float> * done);
            shown.positions[k] = from + done * (to - from) + Vec3{0, 2.5f * hop, 0};
        }
    });
}

}  // namespace ballpit
