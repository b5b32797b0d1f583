// What chapter 06's checks are made of: scenes, the search on a device, an oracle that compares
// every ball with every other, and the known mistakes.
#pragma once

#include "06_broad_phase/broad_phase.cuh"

#include <algorithm>

#include "chapters/06_broad_phase/built_grid.cuh"
#include "common/random.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

using Balls = std::vector<Vec4>;  // x, y, z, radius in m
using Pairs = std::vector<Pair>;
using Words = std::vector<std::uint32_t>;

struct Scene06 {
    std::string name;
    Balls balls;
    Bounds bounds;
    float cellSize = 1.0f;
};

/// A length for people: 0.9 m, not 0.899999976.
inline std::string metres(float length) {
    char words[32];
    std::snprintf(words, sizeof words, "%g m", static_cast<double>(length));
    return words;
}

inline Spheres spheresOf(const Balls& balls) {
    Spheres spheres;
    for (const Vec4 ball : balls) spheres.add(xyz(ball), {}, ball.w, 1.0f, 1.0f);
    return spheres;
}

inline Balls scattered(int count, Bounds box, float smallest, float largest, std::uint64_t seed) {
    Random random(seed);
    Balls balls;
    for (int k = 0; k < count; ++k) {
        const Vec3 place = random.uniformIn(box);
        balls.push_back(withW(place, random.uniform(smallest, largest)));
    }
    return balls;
}

// ---- what is right

inline bool areTouching(Vec4 a, Vec4 b) {
    const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, reach = a.w + b.w;
    return dx * dx + dy * dy + dz * dz < reach * reach;
}

/// All pairs of touching balls, by their place in the list.
inline Pairs touchingPairs(const Balls& balls) {
    Pairs pairs;
    for (std::uint32_t a = 0; a < balls.size(); ++a)
        for (std::uint32_t b = a + 1; b < balls.size(); ++b)
            if (areTouching(balls[a], balls[b])) pairs.push_back({a, b});
    return pairs;
}

/// The cell with this number: steps through rows and layers, without a division.
inline Int3 cellNumbered(Int3 resolution, std::uint32_t number) {
    Int3 cell{0, 0, 0};
    const auto row = static_cast<std::uint32_t>(resolution.x);
    for (; number >= row; number -= row)
        if (++cell.y == resolution.y) cell.y = 0, ++cell.z;
    cell.x = static_cast<int>(number);
    return cell;
}

inline bool areNeighbours(Int3 a, Int3 b) {
    return std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1 && std::abs(a.z - b.z) <= 1;
}

// ---- the piece on a device

/// A scene in its grid, as the search gets it. Behind the balls lie ghosts that touch everything: a
/// search that goes too far is seen.
class Ground {
public:
    Ground(Device device, const Scene06& scene)
        : grid(device, spheresOf(scene.balls), scene.bounds, scene.cellSize),
          positions_(device, scene.balls.size() + ghosts, "positions") {
        for (const std::uint32_t id : grid.ids()) balls.push_back(scene.balls.at(id));
        Balls all = balls;
        all.resize(balls.size() + ghosts, Vec4{0, 0, 0, 1e9f});
        positions_.upload(all);
        for (const std::uint32_t hash : grid.hashes())
            cells.push_back(cellNumbered(grid.resolution(), hash));
    }

    View<const Vec4> positions() { return positions_.view(); }

    BuiltGrid grid;
    Balls balls;              ///< by slot
    std::vector<Int3> cells;  ///< by slot

private:
    static constexpr std::size_t ghosts = 64;
    DeviceBuffer<Vec4> positions_;
};

/// What a search leaves behind.
struct Found {
    Words starts;  ///< where each slot's pairs start; the last: how many pairs were found
    Pairs stored;
    std::uint32_t firstRound = 0, needed = 0, rounds = 0;  ///< what the host was told
    bool operator==(const Found&) const = default;
};

/// The arrays of a search. They are used again and again, as an engine does, and full of nonsense
/// at first.
class Searcher {
public:
    Searcher(Device device, std::size_t count, std::size_t capacity)
        : device_(device),
          list_(device, count, capacity),
          status_(device, 1, "status"),
          scratch_(device, 0, "scratch") {
        for (DeviceBuffer<std::uint32_t>* array : {&list_.starts, &list_.counts, &list_.remembered})
            array->fill(0xAB);
        list_.pairs.fill(0xAB);
    }

    Found search(Ground& ground) {
        status_.fill(0);
        findPairsGrid(device_, ground.grid.count(), ground.grid.view(), ground.grid.sortedHashes(),
                      ground.positions(), list_, status_.view(), scratch_);
        const StepStatus status = status_.download()[0];
        const Words starts = list_.starts.download();
        const std::size_t stored = std::min<std::size_t>(starts.back(), list_.pairs.count());
        return {starts, list_.pairs.download(stored), status.collisions, status.pairsNeeded,
                status.roundsDetected};
    }

private:
    Device device_;
    PairList list_;
    DeviceBuffer<StepStatus> status_;
    Scratch scratch_;
};

/// A search with more than enough room.
inline Found found(Device device, Ground& ground) {
    const std::size_t count = ground.balls.size();
    return Searcher(device, count, std::min<std::size_t>(count * count, 400000)).search(ground);
}

// ---- the known mistakes

/// From the cell of a pair's first ball to that of its second.
inline Int3 stepBetween(const Ground& ground, Pair p) {
    const Int3 a = ground.cells[p.first], b = ground.cells[p.second];
    return {b.x - a.x, b.y - a.y, b.z - a.z};
}

/// The pairs for which `keep` holds.
template <class Keep>
Pairs only(const Pairs& pairs, Keep keep) {
    Pairs kept;
    std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(kept), keep);
    return kept;
}

/// Of each slot's partners the first few.
inline Pairs atMost(std::size_t most, const Pairs& pairs) {
    Pairs kept;
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (k < most || pairs[k - most].first != pairs[k].first) kept.push_back(pairs[k]);
    return kept;
}

inline void guessMistake(Report& report, const Ground& ground, Pairs got, const Pairs& right) {
    std::sort(got.begin(), got.end());
    const auto any = [&](auto claim) { return std::any_of(got.begin(), got.end(), claim); };
    const auto lacks = [&](auto missing) {
        return got != right &&
               got == only(right, [&](Pair p) { return !missing(stepBetween(ground, p)); });
    };
    const auto row = [&](int dy, int dz) {
        return [=] { return lacks([=](Int3 d) { return d.y == dy && d.z == dz; }); };
    };
    const auto own = [](Int3 d) { return d.x == 0 && d.y == 0 && d.z == 0; };
    const bool twice = std::adjacent_find(got.begin(), got.end()) != got.end();
    const bool narrow = ground.grid.resolution().x < 3;
    report.guess({
        {"one slot too many: a run stops before its end",
         [&] { return any([&](Pair p) { return p.second >= ground.balls.size(); }); }},
        {"a ball compared with itself: the search starts behind slot i",
         [&] { return any([](Pair p) { return p.first == p.second; }); }},
        {"pairs found from both sides: only slots after i are searched",
         [&] { return any([](Pair p) { return p.second < p.first; }); }},
        {"a search that wraps around the edge of the world: left of a row's first cell lies the "
         "last cell of another row",
         [&] { return twice && narrow; }},
        {"26 cells: the own cell is missing", [&] { return lacks(own); }},
        {"the own cell only: partners in neighbouring cells are missed",
         [&] { return lacks([&](Int3 d) { return !own(d); }); }},
        {"the own row ends with the own cell: the cell to the right is missing",
         [&] { return lacks([](Int3 d) { return d.x == 1 && d.y == 0 && d.z == 0; }); }},
        {"a row is missing: the next one of the own layer (1, 0)", row(1, 0)},
        {"a row is missing: (-1, 1) in the next layer", row(-1, 1)},
        {"a row is missing: (0, 1) in the next layer", row(0, 1)},
        {"a row is missing: (1, 1) in the next layer", row(1, 1)},
        {"one layer only: the three rows of the next layer are missing",
         [&] { return lacks([](Int3 d) { return d.z == 1; }); }},
        {"a silent cap: no ball has more than the " + text(rememberedPartners) +
             " partners that are remembered",
         [&] { return got != right && got == atMost(rememberedPartners, right); }},
        {"every candidate is listed: the touch test is missing",
         [&] {
             return got.size() > right.size() &&
                    std::includes(got.begin(), got.end(), right.begin(), right.end()) &&
                    std::none_of(got.begin(), got.end(), [&](Pair p) {
                        return p.second >= ground.balls.size() ||
                               !areNeighbours(ground.cells[p.first], ground.cells[p.second]);
                    });
         }},
    });
}

// ---- the claim that most checks share

inline std::string describe(const Ground& ground, Pair p) {
    if (p.first >= ground.balls.size() || p.second >= ground.balls.size())
        return ", but there are only " + text(ground.balls.size()) + " slots";
    const Vec4 a = ground.balls[p.first], b = ground.balls[p.second];
    return ", " + text(length(xyz(b) - xyz(a))) + " m apart, in cells " +
           text(ground.cells[p.first]) + " and " + text(ground.cells[p.second]);
}

/// The list holds the pairs of slot 0, then those of slot 1, and so on, each once; what the host
/// was told is how many there are.
inline void requireOrdered(Report& report, const Found& found, const std::string& where) {
    const auto count = static_cast<std::uint32_t>(found.starts.size() - 1);
    if (found.needed != found.starts.back() || found.firstRound != found.starts.back())
        if (count > 0)
            report.fail(
                "pairs reported" + where,
                text(found.firstRound) + " in the first round, " + text(found.needed) + " at most",
                text(found.starts.back()) + ", as many as the list has");
    for (std::size_t k = 0; k < found.stored.size(); ++k) {
        const Pair p = found.stored[k];
        const std::string entry = "entry " + text(k) + " of the list" + where;
        if (!(p.first < p.second))
            report.fail(entry, text(p), "the ball first that comes first in memory");
        else if (k > 0 && p == found.stored[k - 1])
            report.fail(entry, text(p) + " again", "each pair once");
        else if (p.first >= count || k < found.starts[p.first] || k >= found.starts[p.first + 1])
            report.fail(entry, text(p), "a pair of the slot whose places these are");
    }
}

inline bool requirePairs(Report& report, const Ground& ground, const Found& found,
                         const Pairs& expected, const std::string& where) {
    if (!samePairs(report, found.stored, expected,
                   [&](Pair p) { return describe(ground, p) + where; }))
        guessMistake(report, ground, found.stored, expected);
    requireOrdered(report, found, where);
    return !report.failed();
}

}  // namespace ballpit::check
