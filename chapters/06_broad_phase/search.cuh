// The chapter's balls, the two searches for touching pairs among them, and what one ball sees.
#pragma once

#include "06_broad_phase/broad_phase.cuh"
#include "chapters/06_broad_phase/built_grid.cuh"
#include "common/random.h"

namespace ballpit {

/// Balls of 1 m diameter, and cells just as wide.
struct World {
    Spheres spheres;
    Bounds bounds;
    float cellSize = 1.0f;
};

/// About one ball for three cells. Zero is in the middle, so that half of all coordinates are
/// negative.
inline World scatteredBalls(int count, std::uint64_t seed) {
    const float half = 0.75f * std::cbrt(static_cast<float>(count));
    World world{{}, {{-half, -half, -half}, {half, half, half}}};
    Random random(seed);
    for (int k = 0; k < count; ++k)
        world.spheres.add(random.uniformIn(world.bounds), {}, 0.5f, 1.0f, 1.0f);
    return world;
}

/// How many balls does the ball of slot i compare itself with?
HD inline void countCandidates(int i, GridView grid, View<const std::uint32_t> sortedHashes,
                               View<std::uint32_t> lengths) {
    std::uint32_t length = 0;
    for (const SlotRange& row : rangesAfter(i, grid, sortedHashes).rows)
        if (row.begin < row.end) length += row.end - row.begin;
    lengths[i] = length;
}

HD inline void writeRanges(int i, GridView grid, View<const std::uint32_t> sortedHashes,
                           View<SearchRanges> ranges) {
    ranges[i] = rangesAfter(i, grid, sortedHashes);
}

/// Two numbers each, one after the other.
template <class Twos>
std::vector<std::uint32_t> words(const Twos& twos) {
    std::vector<std::uint32_t> all;
    for (const auto& [a, b] : twos) all.insert(all.end(), {a, b});
    return all;
}

/// The search in the grid, with a list that is as long as it must be.
class Search {
public:
    Search(Device device, const World& world)
        : grid(device, world.spheres, world.bounds, world.cellSize),
          device_(device),
          list_(device, world.spheres.count(), 0),
          status_(device, 1, "status"),
          scratch_(device, 0, "scratch") {
        find();  // a full list says how long it must be
        list_.pairs.resize(found());
    }

    void find() {
        status_.fill(0);
        findPairsGrid(device_, grid.count(), grid.view(), grid.sortedHashes(), grid.positions(),
                      list_, status_.view(), scratch_);
    }

    /// All pairs, by slot.
    std::vector<Pair> pairs() const { return list_.pairs.download(); }

    /// How many comparisons all searches make together.
    std::int64_t candidates() {
        DeviceBuffer<std::uint32_t> lengths(device_, list_.counts.count(), "lengths");
        launch<countCandidates>(device_, grid.count(), grid.view(), grid.sortedHashes(),
                                lengths.view());
        std::int64_t sum = 0;
        for (const std::uint32_t length : lengths.download()) sum += length;
        return sum;
    }

    /// The five runs of one slot.
    SearchRanges rangesOf(int slot) {
        DeviceBuffer<SearchRanges> ranges(device_, list_.counts.count(), "ranges");
        launch<writeRanges>(device_, grid.count(), grid.view(), grid.sortedHashes(), ranges.view());
        return ranges.download().at(static_cast<std::size_t>(slot));
    }

    /// The slot of the ball that is nearest to the middle of the world.
    int slotInTheMiddle(const World& world) {
        const std::vector<Vec3> places = inSlots(world.spheres.positions);
        const auto nearer = [](Vec3 a, Vec3 b) { return lengthSquared(a) < lengthSquared(b); };
        return static_cast<int>(std::min_element(places.begin(), places.end(), nearer) -
                                places.begin());
    }

    std::vector<Vec3> inSlots(const std::vector<Vec3>& byBall) {
        std::vector<Vec3> slots;
        for (const std::uint32_t id : grid.ids()) slots.push_back(byBall.at(id));
        return slots;
    }

    /// How one ball sees each slot, as colour and radius: itself blue, what it compares itself with
    /// grey, its partners among these red, all others as dots.
    std::vector<Vec4> looksFor(int seeker) {
        const auto count = static_cast<std::size_t>(grid.count());
        std::vector<Vec4> looks(count, Vec4{0.25f, 0.25f, 0.28f, 0.06f});
        for (const auto [begin, end] : rangesOf(seeker).rows)
            for (std::uint32_t j = begin; j < end; ++j) looks.at(j) = {0.66f, 0.67f, 0.7f, 0.5f};
        for (const auto [first, second] : pairs())
            if (first == static_cast<std::uint32_t>(seeker))
                looks.at(second) = {0.86f, 0.15f, 0.13f, 0.5f};
        looks.at(static_cast<std::size_t>(seeker)) = {0.1f, 0.4f, 0.85f, 0.5f};
        return looks;
    }

    /// The neighbourhood of one ball. Of the dots only those near by.
    World seenBy(int seeker, const World& world) {
        const std::vector<Vec3> places = inSlots(world.spheres.positions);
        const std::vector<Vec4> looks = looksFor(seeker);
        const Vec3 middle = places.at(static_cast<std::size_t>(seeker)), reach{2.5f, 2.5f, 2.5f};
        World seen{{}, {middle - reach, middle + reach}};
        for (std::size_t k = 0; k < places.size(); ++k)
            if (length(places[k] - middle) < 2.5f || looks[k].w == 0.5f)
                seen.spheres.add(places[k], {}, looks[k].w, 1.0f, 1.0f, xyz(looks[k]));
        return seen;
    }

    BuiltGrid grid;

private:
    std::uint32_t found() const { return list_.starts.download().back(); }

    Device device_;
    PairList list_;
    DeviceBuffer<StepStatus> status_;
    Scratch scratch_;
};

/// Every ball with every other: chapter 01's, for comparison.
class NaiveSearch {
public:
    NaiveSearch(Device device, const Spheres& spheres)
        : device_(device),
          positions_(device, spheres.count(), "positions"),
          pairs_(device, 4 * spheres.count(), "pairs"),
          found_(device, 1, "found") {
        std::vector<Vec4> balls;
        for (std::size_t k = 0; k < spheres.count(); ++k)
            balls.push_back(withW(spheres.positions[k], spheres.radii[k]));
        positions_.upload(balls);
    }

    void find() {
        found_.fill(0);
        launchFindPairsNaive(device_, static_cast<int>(positions_.count()), positions_.view(),
                             pairs_.view(), found_.view());
    }

private:
    Device device_;
    DeviceBuffer<Vec4> positions_;
    DeviceBuffer<Pair> pairs_;
    DeviceBuffer<std::uint32_t> found_;
};

}  // namespace ballpit
