// For the checks of chapter 02: runs the piece, knows what is right and what the classic mistakes
// give, and draws. The oracle counts faces and cells one by one, so it shares neither floor nor
// clamp nor formula with the piece.
#pragma once

#include "02_grid_hash/grid_hash.cuh"

#include <algorithm>

#include "common/random.h"
#include "common/spheres.h"
#include "tests/checks/canvas.h"
#include "tests/checks/contention.cuh"

namespace ballpit::check {

/// A box, and cells that divide it evenly.
struct World {
    Bounds bounds;
    float cellSize;
    Int3 resolution;
};

// Sides and corners are whole numbers and cells are 2 m, so that nothing is rounded.
constexpr World lesson{{{-4, -3, -2}, {4, 3, 2}}, 2, {4, 3, 2}};
constexpr World aroundZero{{{-8, -6, -4}, {8, 6, 4}}, 2, {8, 6, 4}};
constexpr World layer{{{-8, 0, -8}, {8, 4, 8}}, 4, {4, 1, 4}};

// ---- what the piece gives

/// What computeGridHash writes for a list of balls.
struct Hashed {
    std::vector<std::uint32_t> hashes, indices;
    std::uint32_t outside = 0;
    bool operator==(const Hashed&) const = default;
};

/// Asks for cells as the engine makes them: a hair larger.
struct WithHair {};

/// Runs computeGridHash on arrays that still hold what the last run wrote.
class Hasher {
public:
    Hasher(Device device, const World& world, std::size_t most)
        : Hasher(device, world, most, WithHair{}) {
        view_.inverseCellSize = 1.0f / world.cellSize;  // faces lie where they are drawn
    }
    Hasher(Device device, const World& world, std::size_t most, WithHair)
        : device_(device),
          grid_(device, world.bounds, world.cellSize, static_cast<int>(most)),
          positions_(device, 0),
          status_(device, 1, "status"),
          view_(grid_.view()) {}

    Hashed operator()(const std::vector<Vec3>& points) {
        prepare(points);
        launch<computeGridHash>(device_, static_cast<int>(points.size()), view_,
                                View<const Vec4>(positions_.view()), grid_.hashes.view(),
                                grid_.indices.view(), status_.view());
        return {grid_.hashes.download(points.size()), grid_.indices.download(points.size()),
                outside()};
    }

    /// How many are counted as outside when threads count at the same time.
    std::pair<std::uint32_t, Contention> countContended(const std::vector<Vec3>& points) {
        prepare(points);
        const Contention contention = launchUntilContended<computeGridHash>(
            device_, static_cast<int>(points.size()), view_, View<const Vec4>(positions_.view()),
            grid_.hashes.view(), grid_.indices.view(), status_.view());
        return {outside(), contention};
    }

private:
    void prepare(const std::vector<Vec3>& points) {
        std::vector<Vec4> balls;
        for (const Vec3 p : points) balls.push_back(withW(p, 0.5f));
        positions_ = uploaded(device_, balls, "positions");
        status_.fill(0);
    }
    std::uint32_t outside() const { return status_.download()[0].outside; }

    Device device_;
    UniformGrid grid_;
    DeviceBuffer<Vec4> positions_;
    DeviceBuffer<StepStatus> status_;
    GridView view_;
};

/// What no threads can disturb.
inline std::uint32_t countedByOneThread(const World& world, const std::vector<Vec3>& points) {
    const Threads one(LaunchOrder::forward, 1);
    return Hasher(Device::cpu, world, points.size())(points).outside;
}

/// Where a ball is put when it is alone.
struct Place {
    std::uint32_t hash;
    bool outside;
    bool operator==(const Place&) const = default;
};

inline std::string text(Place place) {
    return "hash " + text(place.hash) +
           (place.outside ? ", counted as outside" : ", not counted as outside");
}

inline std::vector<Place> placesOneByOne(Device device, const World& world,
                                         const std::vector<Vec3>& points) {
    Hasher hash(device, world, 1);
    std::vector<Place> places;
    for (const Vec3 p : points) {
        const Hashed one = hash({p});
        places.push_back({one.hashes[0], one.outside != 0});
    }
    return places;
}

// ---- what is right

/// How many faces along one axis a coordinate has passed, less one. NaN passes none.
inline int cellByWalking(double coordinate, double origin, double cellSize, int resolution) {
    int cell = -1;
    while (cell < resolution && coordinate >= origin + (cell + 1) * cellSize) ++cell;
    return cell;
}

inline int nearest(int cell, int resolution) { return std::clamp(cell, 0, resolution - 1); }

/// Counted: whole layers, then whole rows, then cells.
inline std::uint32_t numberOf(Int3 r, Int3 c) {
    std::uint32_t number = 0;
    for (int z = 0; z < nearest(c.z, r.z); ++z) number += std::uint32_t(r.x * r.y);
    for (int y = 0; y < nearest(c.y, r.y); ++y) number += std::uint32_t(r.x);
    return number + std::uint32_t(nearest(c.x, r.x));
}

/// A way to find the cell along one axis, right or wrong.
using Axis = int (*)(double coordinate, double origin, double cellSize, int resolution);

inline Int3 cellIn(const World& w, Vec3 p, Axis along) {
    const Vec3 o = w.bounds.lower;
    return {along(p.x, o.x, w.cellSize, w.resolution.x),
            along(p.y, o.y, w.cellSize, w.resolution.y),
            along(p.z, o.z, w.cellSize, w.resolution.z)};
}

inline Place placeOf(const World& world, Vec3 p, Axis along = cellByWalking) {
    const Int3 r = world.resolution, c = cellIn(world, p, along);
    const bool inside = c.x >= 0 && c.x < r.x && c.y >= 0 && c.y < r.y && c.z >= 0 && c.z < r.z;
    return {numberOf(r, c), !inside};
}

inline std::vector<Place> placesOf(const World& world, const std::vector<Vec3>& points,
                                   Axis along = cellByWalking) {
    std::vector<Place> places;
    for (const Vec3 p : points) places.push_back(placeOf(world, p, along));
    return places;
}

/// The cells of a grid in the order of their numbers.
inline std::vector<Int3> cellsInOrder(Int3 r) {
    std::vector<Int3> cells;
    for (int z = 0; z < r.z; ++z)
        for (int y = 0; y < r.y; ++y)
            for (int x = 0; x < r.x; ++x) cells.push_back({x, y, z});
    return cells;
}

inline std::vector<Vec3> randomPoints(int count, Bounds box, std::uint64_t seed) {
    Random random(seed);
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) points.push_back(random.uniformIn(box));
    return points;
}

// ---- the classic mistakes, for the guess

inline int castAfterOrigin(double coordinate, double origin, double cellSize, int resolution) {
    return std::clamp(static_cast<int>((coordinate - origin) / cellSize), -1, resolution);
}
inline int castBeforeOrigin(double coordinate, double origin, double cellSize, int resolution) {
    const int cell = static_cast<int>(coordinate / cellSize) - static_cast<int>(origin / cellSize);
    return std::clamp(cell, -1, resolution);
}
inline int dividedByInverse(double coordinate, double origin, double cellSize, int resolution) {
    const double cell = std::floor((coordinate - origin) * cellSize);  // / (1 / cellSize)
    return cell > -1 ? static_cast<int>(std::min<double>(cell, resolution)) : -1;
}
inline int signSwapped(double coordinate, double origin, double cellSize, int resolution) {
    return dividedByInverse(origin, coordinate, 1 / cellSize, resolution);
}
inline int roundedUp(double coordinate, double origin, double cellSize, int resolution) {
    return std::clamp(static_cast<int>(std::ceil((coordinate - origin) / cellSize)) - 1, -1,
                      resolution);
}

constexpr const char* castBelowName =
    "a cast to int in place of floor: it rounds -0.5 up to 0, so a ball just below the grid counts "
    "as inside";
constexpr const char* castAtZeroName =
    "a cast to int in place of floor: -0.5 and 0.5 both become 0, so the cells on both sides of "
    "zero become one";
constexpr const char* dividedName =
    "a division by inverseCellSize: it is 1 / cell size already, so multiply";
constexpr const char* signName =
    "origin - coordinate: the distance from the lower wall is coordinate - origin";
constexpr const char* axesName = "the axes in the wrong order: x must run fastest, z slowest";
constexpr const char* widthName =
    "a wrong row length: a row has resolution.x cells, a layer has "
    "resolution.y rows";

/// The student's cellAlongAxis.
inline int yourAxis(double coordinate, double origin, double cellSize, int resolution) {
    return cellAlongAxis(static_cast<float>(coordinate), static_cast<float>(origin),
                         1.0f / static_cast<float>(cellSize), resolution);
}

/// Guesses from the hashes of many balls and from how many were counted as outside. A mistake along
/// an axis is only named if cellAlongAxis, too, gives just what the mistake gives: where few balls
/// are outside, one that is not counted looks like one that a cast took inside.
inline void guessMistake(Report& report, const World& world, const std::vector<Vec3>& points,
                         const Hashed& got) {
    const auto hashedBy = [&](Axis along) {
        Hashed hashed{{}, got.indices};
        for (const Place& place : placesOf(world, points, along)) {
            hashed.hashes.push_back(place.hash);
            hashed.outside += place.outside;
        }
        return hashed;
    };
    const Hashed right = hashedBy(cellByWalking);
    if (got == right) return;
    const auto gives = [&](Axis along) {
        return [&, along] {
            return got == hashedBy(along) && std::all_of(points.begin(), points.end(), [&](Vec3 p) {
                       return isSameCell(cellIn(world, p, yourAxis), cellIn(world, p, along));
                   });
        };
    };
    const auto numbers = [&](auto number) {
        return [&, number] {
            for (std::size_t k = 0; k < points.size(); ++k) {
                const Int3 c = cellsInOrder(world.resolution)[placeOf(world, points[k]).hash];
                if (got.hashes[k] != std::uint32_t(number(world.resolution, c))) return false;
            }
            return true;
        };
    };
    report.guess(
        {{castBelowName, gives(castAfterOrigin)},
         {castAtZeroName, gives(castBeforeOrigin)},
         {"rounding up: a ball on a face belongs to the cell above", gives(roundedUp)},
         {dividedName, gives(dividedByInverse)},
         {signName, gives(signSwapped)},
         {"the test for outside the wrong way round: the balls inside are counted",
          [&] {
              return got.hashes == right.hashes && right.outside > 0 &&
                     got.outside == points.size() - right.outside;
          }},
         {axesName, numbers([](Int3 r, Int3 c) { return (c.x * r.y + c.y) * r.z + c.z; })},
         {widthName, numbers([](Int3 r, Int3 c) { return (c.z * r.x + c.y) * r.y + c.x; })}});
}

// ---- the picture

/// One layer of cells from above. Balls have the colour of their cell; balls counted as outside are
/// rings. Yours, reference, and what differs in red.
inline Frame drawLayer(const std::vector<Vec3>& points, const std::vector<Place>& got,
                       const std::vector<Place>& expected) {
    const auto colorOf = [](std::uint32_t hash) {
        const std::uint32_t x = hash % 4, z = hash / 4;  // neighbours differ
        return paletteColor(3 * (x % 2) + 6 * (z % 2) + 4 * (x / 2 % 2));
    };
    return threePanels(-10, -10, 20, 300, [&](Canvas& canvas, const Panel& panel, int k) {
        for (const float at : {-8.0f, -4.0f, 0.0f, 4.0f, 8.0f}) {
            canvas.line(panel.x(at), panel.y(-8), panel.x(at), panel.y(8), 2, colors::grey);
            canvas.line(panel.x(-8), panel.y(at), panel.x(8), panel.y(at), 2, colors::grey);
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Place place = k == 0 ? got[i] : expected[i];
            const float x = panel.x(points[i].x), y = panel.y(points[i].z);
            if (k == 2)
                canvas.disc(x, y, 4, got[i] == expected[i] ? colors::line : colors::red);
            else if (place.outside)
                canvas.ring(x, y, 3.5f, 1.5f, colors::ink);
            else
                canvas.disc(x, y, 4, colorOf(place.hash));
        }
    });
}

inline void drawIfWrong(Report& report) {
    if (!report.failed()) return;
    report.picture([&] {
        const std::vector<Vec3> points =
            randomPoints(900, {{-9.8f, 0, -9.8f}, {9.8f, 4, 9.8f}}, report.seed);
        return drawLayer(points, placesOneByOne(report.device, layer, points),
                         placesOf(layer, points));
    });
}

}  // namespace ballpit::check
