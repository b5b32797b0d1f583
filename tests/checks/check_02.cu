// Checks of chapter 02: from positions to cell numbers. The oracle finds a cell by walking from
// cell to cell, so it shares neither floor nor clamp nor formula with the piece.
#include "02_grid_hash/grid_hash.cuh"

#include <algorithm>
#include <set>

#include "common/random.h"
#include "common/spheres.h"
#include "tests/checks/canvas.h"
#include "tests/checks/check.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

/// What computeGridHash writes for a list of positions.
struct Hashed {
    std::vector<std::uint32_t> hashes, indices;
    std::uint32_t outside;
    bool operator==(const Hashed&) const = default;
};

/// The world of a check: a box, and cells that divide it evenly.
struct World {
    Bounds bounds;
    float cellSize;
};

constexpr World aroundZero{{{-6, -4.5f, -3}, {6, 4.5f, 3}}, 1.5f};  // 8 x 6 x 4 cells

GridView viewOf(UniformGrid& grid, const World& world) {
    GridView view = grid.view();
    view.inverseCellSize = 1.0f / world.cellSize;  // no hair: faces lie where they are drawn
    return view;
}

Hashed hashAll(Device device, const World& world, const std::vector<Vec3>& points) {
    const int count = static_cast<int>(points.size());
    UniformGrid grid(device, world.bounds, world.cellSize, count);
    std::vector<Vec4> balls;
    for (const Vec3 p : points) balls.push_back(withW(p, 0.5f));
    auto positions = uploaded(device, balls, "positions");
    DeviceBuffer<StepStatus> status(device, 1, "status");
    status.fill(0);
    launch<computeGridHash>(device, count, viewOf(grid, world), View<const Vec4>(positions.view()),
                            grid.hashes.view(), grid.indices.view(), status.view());
    return {grid.hashes.download(), grid.indices.download(), status.download()[0].outside};
}

/// The last cell face along one axis that the coordinate has passed, by walking.
int walkToCell(float coordinate, float origin, float inverseCellSize, int resolution) {
    const float inCells = (coordinate - origin) * inverseCellSize;
    int cell = -1;
    while (cell < resolution && static_cast<float>(cell + 1) <= inCells) ++cell;
    return cell;
}

Int3 resolutionOf(const World& world) {
    const Vec3 size = extent(world.bounds);
    const auto cells = [&](float length) { return int(std::lround(length / world.cellSize)); };
    return {cells(size.x), cells(size.y), cells(size.z)};
}

/// A way to turn three cell coordinates, one step outside the grid at most, into a number.
using Numbering = std::uint32_t (*)(Int3 resolution, Int3 cell);

int nearest(int cell, int resolution) { return std::clamp(cell, 0, resolution - 1); }

std::uint32_t rightNumber(Int3 r, Int3 c) {
    // Counted, not computed: whole layers, then whole rows, then cells.
    std::uint32_t number = 0;
    for (int z = 0; z < nearest(c.z, r.z); ++z) number += std::uint32_t(r.x * r.y);
    for (int y = 0; y < nearest(c.y, r.y); ++y) number += std::uint32_t(r.x);
    return number + std::uint32_t(nearest(c.x, r.x));
}

std::vector<std::uint32_t> expectedHashes(const World& world, const std::vector<Vec3>& points,
                                          Numbering number = rightNumber,
                                          decltype(&walkToCell) along = walkToCell) {
    const Int3 r = resolutionOf(world);
    const Vec3 o = world.bounds.lower;
    const float inverse = 1.0f / world.cellSize;
    std::vector<std::uint32_t> hashes;
    for (const Vec3 p : points)
        hashes.push_back(number(r, {along(p.x, o.x, inverse, r.x), along(p.y, o.y, inverse, r.y),
                                    along(p.z, o.z, inverse, r.z)}));
    return hashes;
}

std::uint32_t expectedOutside(const World& world, const std::vector<Vec3>& points) {
    const Int3 r = resolutionOf(world);
    const Vec3 o = world.bounds.lower;
    const float inverse = 1.0f / world.cellSize;
    const auto isOutside = [&](float coordinate, float origin, int resolution) {
        const int cell = walkToCell(coordinate, origin, inverse, resolution);
        return cell < 0 || cell >= resolution;
    };
    return static_cast<std::uint32_t>(std::count_if(points.begin(), points.end(), [&](Vec3 p) {
        return isOutside(p.x, o.x, r.x) || isOutside(p.y, o.y, r.y) || isOutside(p.z, o.z, r.z);
    }));
}

// The classic mistakes, for the guess.

int castOfCoordinate(float coordinate, float origin, float inverseCellSize, int resolution) {
    const int cell = static_cast<int>(coordinate * inverseCellSize) -
                     static_cast<int>(std::floor(origin * inverseCellSize));
    return std::clamp(cell, -1, resolution);
}
std::uint32_t axesSwapped(Int3 r, Int3 c) { return rightNumber({r.z, r.y, r.x}, {c.z, c.y, c.x}); }
std::uint32_t widthForgotten(Int3 r, Int3 c) {
    return std::uint32_t((nearest(c.z, r.z) * r.x + nearest(c.y, r.y)) * r.y + nearest(c.x, r.x));
}

void guessMistake(Report& report, const World& world, const std::vector<Vec3>& points,
                  const std::vector<std::uint32_t>& got) {
    const auto equals = [&](Numbering number, decltype(&walkToCell) along) {
        return [&, number, along] { return got == expectedHashes(world, points, number, along); };
    };
    report.guess({{"a cast to int in place of floor: it rounds towards zero, so the cells -0.7 and "
                   "0.7 become one",
                   equals(rightNumber, castOfCoordinate)},
                  {"the axes in the wrong order: x must run fastest, z slowest",
                   equals(axesSwapped, walkToCell)},
                  {"the wrong row length: a layer is resolution.y rows of resolution.x cells",
                   equals(widthForgotten, walkToCell)}});
}

std::vector<Vec3> randomPoints(int count, Bounds box, std::uint64_t seed) {
    Random random(seed);
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) points.push_back(random.uniformIn(box));
    return points;
}

/// Yours, reference, and what differs in red: balls of one layer in the colour of their cell.
Frame drawCells(const World& world, const std::vector<Vec3>& points,
                const std::vector<std::uint32_t>& got, const std::vector<std::uint32_t>& expected) {
    const Vec3 lower = world.bounds.lower;
    return threePanels(
        lower.x, lower.z, extent(world.bounds).x, 300,
        [&](Canvas& canvas, const Panel& panel, int k) {
            const int cells = resolutionOf(world).x;
            const float side = extent(world.bounds).x;
            for (int c = 1; c < cells; ++c) {
                const float at = static_cast<float>(c) * world.cellSize;
                canvas.line(panel.x(lower.x + at), panel.y(lower.z), panel.x(lower.x + at),
                            panel.y(lower.z + side), 1.0f, colors::line);
                canvas.line(panel.x(lower.x), panel.y(lower.z + at), panel.x(lower.x + side),
                            panel.y(lower.z + at), 1.0f, colors::line);
            }
            for (std::size_t i = 0; i < points.size(); ++i) {
                const std::uint32_t hash = k == 0 ? got[i] : expected[i];
                const bool wrong = got[i] != expected[i];
                const Vec3 color = k < 2   ? paletteColor(hash * 2654435761u >> 16)
                                   : wrong ? colors::red
                                           : colors::grey;
                canvas.disc(panel.x(points[i].x), panel.y(points[i].z), 4.0f, color);
            }
        });
}

/// The claim that most checks share.
void requireRightHashes(Report& report, const World& world, const std::vector<Vec3>& points) {
    const Hashed got = hashAll(report.device, world, points);
    const std::vector<std::uint32_t> expected = expectedHashes(world, points);
    const auto ball = [&](std::size_t k) {
        return "hash of ball " + text(k) + " at " + text(points[k]);
    };
    if (!sameElements(report, got.hashes, expected, ball))
        guessMistake(report, world, points, got.hashes);
    for (std::size_t k = 0; k < points.size(); ++k)
        if (got.indices[k] != k)
            report.fail("index of ball " + text(k), text(got.indices[k]), text(k));
    if (got.outside != expectedOutside(world, points))
        report.fail("balls counted as outside", text(got.outside),
                    text(expectedOutside(world, points)));
}

// ---- the checks

void axisByHand(Report& report) {
    struct Row {
        float coordinate;
        int cell;
        const char* where;
    };
    // Cells of 1.5 m from -6 on, eight of them.
    for (const Row& row : {Row{-6.0f, 0, "on the lower wall"},
                           {-5.9f, 0, "just inside"},
                           {-4.5f, 1, "on a face: it belongs to the cell above"},
                           {-0.75f, 3, "in the middle of a cell"},
                           {0.0f, 4, "at zero"},
                           {5.9f, 7, "in the last cell"},
                           {6.0f, 8, "on the upper wall"},
                           {-6.1f, -1, "just outside"},
                           {-7.4f, -1, "nearly a cell outside"},
                           {1e30f, 8, "far outside"},
                           {-1e30f, -1, "far outside"},
                           {std::numeric_limits<float>::quiet_NaN(), -1, "not a number"}}) {
        const int cell = cellAlongAxis(row.coordinate, -6.0f, 1.0f / 1.5f, 8);
        if (cell != row.cell)
            report.fail("cell along x of " + text(row.coordinate) + " m (" + row.where + ")",
                        text(cell), text(row.cell));
    }
    report.guess(
        {{"a cast to int in place of floor: it rounds towards zero, so just outside the "
          "lower wall looks like the first cell",
          [] {
              return cellAlongAxis(-6.1f, -6.0f, 1.0f / 1.5f, 8) == 0 &&
                     cellAlongAxis(-7.6f, -6.0f, 1.0f / 1.5f, 8) == -1;
          }}});
}

void clampByHand(Report& report) {
    struct Row {
        int index, count, nearest;
    };
    for (const Row& row : {Row{-1, 8, 0},
                           {0, 8, 0},
                           {3, 8, 3},
                           {7, 8, 7},
                           {8, 8, 7},
                           {900, 8, 7},
                           {-1, 1, 0},
                           {0, 1, 0},
                           {1, 1, 0}}) {
        const int nearest = clampIndex(row.index, row.count);
        if (nearest != row.nearest)
            report.fail("nearest to " + text(row.index) + " of 0 to " + text(row.count - 1),
                        text(nearest), text(row.nearest));
    }
}

void numberByHand(Report& report) {
    const Int3 resolution{4, 3, 2};
    struct Row {
        Int3 cell;
        std::uint32_t number;
    };
    for (const Row& row : {Row{{0, 0, 0}, 0},
                           {{1, 0, 0}, 1},
                           {{3, 0, 0}, 3},
                           {{0, 1, 0}, 4},
                           {{0, 2, 0}, 8},
                           {{0, 0, 1}, 12},
                           {{2, 1, 1}, 18},
                           {{3, 2, 1}, 23}}) {
        const std::uint32_t number = cellHash(resolution, row.cell);
        if (number != row.number)
            report.fail("number of cell " + text(row.cell) + " in a 4 x 3 x 2 grid", text(number),
                        text(row.number));
    }
    report.guess({{"the axes in the wrong order: x must run fastest, z slowest", [&] {
                       return cellHash(resolution, {0, 0, 1}) == 1;
                   }}});
}

void inverse(Report& report) {
    const Int3 r{5, 3, 4};
    std::uint32_t number = 0;
    for (int z = 0; z < r.z; ++z)
        for (int y = 0; y < r.y; ++y)
            for (int x = 0; x < r.x; ++x, ++number) {
                const Int3 cell = cellFromHash(r, number);
                if (!isSameCell(cell, {x, y, z}))
                    report.fail("cell with number " + text(number) + " in a 5 x 3 x 4 grid",
                                text(cell), text(Int3{x, y, z}));
            }
}

void faces(Report& report) {
    // All corners of all cells, the walls included, and a point a little to each side of them.
    std::vector<Vec3> points;
    for (int x = 0; x <= 8; ++x)
        for (int y = 0; y <= 6; ++y)
            for (int z = 0; z <= 4; ++z)
                for (const float shift : {-0.25f, 0.0f, 0.25f})
                    points.push_back(aroundZero.bounds.lower +
                                     1.5f * Vec3{float(x), float(y), float(z)} +
                                     Vec3{shift, shift, shift});
    requireRightHashes(report, aroundZero, points);
}

void outside(Report& report) {
    const Bounds wide{{-20, -20, -20}, {20, 20, 20}};
    requireRightHashes(report, aroundZero, randomPoints(500, wide, report.seed));
}

void inRange(Report& report) {
    const Bounds wide{{-50, -50, -50}, {50, 50, 50}};
    const std::vector<Vec3> points = randomPoints(2000, wide, report.seed + 1);
    const std::vector<std::uint32_t> hashes = hashAll(report.device, aroundZero, points).hashes;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (hashes[k] >= 8 * 6 * 4)
            report.fail("hash of ball " + text(k) + " at " + text(points[k]), text(hashes[k]),
                        "below 192, the number of cells");
}

void neighbours(Report& report) {
    const std::vector<Vec3> points =
        randomPoints(1000, {{-6, -4.5f, -3}, {4.4f, 2.9f, 1.4f}}, report.seed + 2);
    const std::vector<std::uint32_t> here = hashAll(report.device, aroundZero, points).hashes;
    const auto requireStep = [&](Vec3 step, std::uint32_t distance, const char* axis) {
        std::vector<Vec3> moved;
        for (const Vec3 p : points) moved.push_back(p + step);
        const std::vector<std::uint32_t> there = hashAll(report.device, aroundZero, moved).hashes;
        for (std::size_t k = 0; k < points.size(); ++k) {
            // A ball so near a face that adding the step rounds it across is no evidence.
            const Vec3 back = moved[k] - step;
            if (!(back == points[k])) continue;
            if (there[k] - here[k] != distance)
                report.fail("ball at " + text(points[k]) + ", one cell on along " + axis,
                            "hash +" + text(static_cast<int>(there[k] - here[k])),
                            "hash +" + text(distance));
        }
    };
    requireStep({1.5f, 0, 0}, 1, "x");
    requireStep({0, 1.5f, 0}, 8, "y");
    requireStep({0, 0, 1.5f}, 48, "z");
}

void randomScenes(Report& report) {
    for (const int count : {0, 1, 2, 33, 255, 256, 257, 1000})
        requireRightHashes(report, aroundZero,
                           randomPoints(count, aroundZero.bounds, report.seed + 3));
    // One flat layer, for the picture.
    const World flat{{{-6, 0, -6}, {6, 1.5f, 6}}, 1.5f};
    const std::vector<Vec3> points = randomPoints(600, flat.bounds, report.seed + 4);
    requireRightHashes(report, flat, points);
    if (report.failed())
        report.picture([&] {
            return drawCells(flat, points, hashAll(report.device, flat, points).hashes,
                             expectedHashes(flat, points));
        });
    const std::vector<std::uint32_t> hashes = expectedHashes(flat, points);
    const std::set<std::uint32_t> occupied(hashes.begin(), hashes.end());
    report.measured("of 64 cells of one layer, " + text(occupied.size()) +
                    " hold at least one of 600 balls");
}

void anyOrder(Report& report) {
    const std::vector<Vec3> points = randomPoints(6000, {{-7, -7, -7}, {7, 7, 7}}, report.seed + 5);
    inEveryOrder(report, [&] { return hashAll(report.device, aroundZero, points); });
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "02",
        {{"hash.axis", "A coordinate lies in the cell whose lower face it has passed last",
          "Balls just below zero or just outside the world otherwise share a cell with balls that "
          "are far from them, and faces belong to two cells or none.",
          axisByHand},
         {"hash.clamp", "Outside the grid, the nearest cell is the first or the last",
          "Clamping never moves two cells apart, so balls outside still meet all their neighbours.",
          clampByHand},
         {"hash.number", "Cells are numbered along x first, then y, then z",
          "Chapter 06 reads three neighbours along x as one run of memory. It can because their "
          "numbers follow each other.",
          numberByHand},
         {"hash.inverse", "From a cell's number its coordinates come back",
          "Chapter 06 knows of a ball only the number of its cell, and must find the 26 around it.",
          inverse},
         {"hash.faces", "Every point on a face, edge or corner lies in exactly one cell",
          "Scenes made by people put balls on round numbers, which is where the faces are.", faces},
         {"hash.outside", "A ball outside the world gets the nearest cell and is counted",
          "A number beyond the last cell writes past the end of an array; a ball without a cell "
          "would fall through all others unseen.",
          outside},
         {"hash.range", "A hash is below the number of cells", "It is used as an array index.",
          inRange},
         {"hash.neighbours", "One cell further along x, y, z the hash grows by 1, Rx, Rx * Ry",
          "The search in chapter 06 reaches neighbours by adding these numbers.", neighbours},
         {"hash.random", "Random scenes: every hash equals that of a slow search, cell by cell",
          "What no one thought of.", randomScenes},
         {"hash.order", "The result does not depend on the order of the threads",
          "A GPU gives no order. A count that is not atomic loses some.", anyOrder}});
}
