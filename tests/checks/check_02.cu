// Checks of chapter 02: from positions to cell numbers.
#include <limits>
#include <map>

#include "tests/checks/check_02_cells.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

std::string ballAt(std::size_t k, Vec3 point) { return "ball " + text(k) + " at " + text(point); }

/// What many checks ask of many balls at once.
void requireRight(Report& report, Hasher& hash, const World& world,
                  const std::vector<Vec3>& points) {
    const Hashed got = hash(points);
    std::uint32_t outside = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Place place = placeOf(world, points[k]);
        outside += place.outside;
        if (got.hashes[k] != place.hash)
            report.fail("hash of " + ballAt(k, points[k]), text(got.hashes[k]), text(place.hash));
        if (got.indices[k] != k)
            report.fail("index of ball " + text(k), text(got.indices[k]), text(k));
    }
    if (got.outside != outside)
        report.fail("of " + text(points.size()) + " balls, counted as outside", text(got.outside),
                    text(outside));
    // A few balls are not enough to tell one mistake from another.
    if (points.size() >= 500) guessMistake(report, world, points, got);
}

void axisByHand(Report& report) {
    struct Row {
        float coordinate;
        int cell;
        const char* where;
    };
    const auto cellOnX = [](float coordinate) { return cellAlongAxis(coordinate, -8, 0.5f, 8); };
    for (const Row& row : {Row{-8, 0, "on the lower wall"},
                           {-7.9f, 0, "just inside"},
                           {-6, 1, "on a face: it belongs to the cell above"},
                           {-0.5f, 3, "just below zero"},
                           {0, 4, "at zero, on a face"},
                           {0.5f, 4, "just above zero"},
                           {7.9f, 7, "in the last cell"},
                           {8, 8, "on the upper wall: above the grid"},
                           {11, 8, "above the grid"},
                           {-9, -1, "half a cell below the grid"},
                           {-20, -1, "far below the grid"},
                           {1e30f, 8, "more cells away than an int can count"},
                           {-1e30f, -1, "more cells away than an int can count"},
                           {notANumber, -1, "not a number"}})
        if (cellOnX(row.coordinate) != row.cell)
            report.fail("cell of " + text(row.coordinate) + " m (" + row.where + ")",
                        text(cellOnX(row.coordinate)), text(row.cell));
    report.guess(
        {{castBelowName, [&] { return cellOnX(-9) == 0 && cellOnX(-20) == -1; }},
         {castAtZeroName, [&] { return cellOnX(-0.5f) == 4 && cellOnX(0.5f) == 4; }},
         {"rounding up: a face belongs to the cell above",
          [&] { return cellOnX(0) == 3 && cellOnX(0.5f) == 4; }},
         {dividedName, [&] { return cellOnX(-7.9f) == 0 && cellOnX(-6) == 4; }},
         {signName, [&] { return cellOnX(-9) == 0 && cellOnX(-20) == 6; }},
         {"NaN comes out at the upper end: it fails every comparison, and in minimum(a, b) "
          "and maximum(a, b) a NaN in `a` yields `b` (common/vec3.cuh)",
          [&] { return report.failureCount == 1 && cellOnX(notANumber) == 8; }}});
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
                           {-900, 8, 0},
                           {-1, 1, 0},
                           {0, 1, 0},
                           {1, 1, 0}})
        if (const int index = clampIndex(row.index, row.count); index != row.nearest)
            report.fail("nearest to " + text(row.index) + " of 0 to " + text(row.count - 1),
                        text(index), text(row.nearest));
    report.guess({{"a clamp to count in place of count - 1: the last of 8 cells is number 7",
                   [] { return clampIndex(8, 8) == 8 && clampIndex(900, 8) == 8; }},
                  {"no clamp above: a ball at the upper wall gets a cell that does not exist",
                   [] { return clampIndex(900, 8) == 900; }}});
}

void numberByHand(Report& report) {
    struct Row {
        Int3 cell;
        std::uint32_t number;
    };
    const auto number = [](Int3 cell) { return cellHash({4, 3, 2}, cell); };
    for (const Row& row : {Row{{0, 0, 0}, 0},
                           {{1, 0, 0}, 1},
                           {{3, 0, 0}, 3},
                           {{0, 1, 0}, 4},
                           {{0, 2, 0}, 8},
                           {{0, 0, 1}, 12},
                           {{2, 1, 1}, 18},
                           {{3, 2, 1}, 23}})
        if (number(row.cell) != row.number)
            report.fail("number of cell " + text(row.cell) + " in a 4 x 3 x 2 grid",
                        text(number(row.cell)), text(row.number));
    report.guess({{axesName,
                   [&] {
                       return number({0, 0, 1}) == 1;
                   }},
                  {widthName, [&] {
                       return number({0, 1, 0}) == 3;
                   }}});
}

void inverse(Report& report) {
    const Int3 resolution{5, 3, 4};
    const std::vector<Int3> cells = cellsInOrder(resolution);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const Int3 cell = cellFromHash(resolution, static_cast<std::uint32_t>(k));
        if (!isSameCell(cell, cells[k]))
            report.fail("cell with number " + text(k) + " in a 5 x 3 x 4 grid", text(cell),
                        text(cells[k]));
    }
    report.guess(
        {{"division by the number of rows where a row's length is needed: a row has "
          "resolution.x cells",
          [&] {
              return isSameCell(cellFromHash(resolution, 3), {0, 1, 0});
          }}});
}

void writeByHand(Report& report) {
    // The eight balls of the lesson.
    const std::vector<Vec3> points{{-3, -2, -1}, {-0.5f, -2, -1}, {0.5f, -2, -1}, {3, 2, -1},
                                   {1, 0, 1},    {1.5f, 0.5f, 1}, {3, 2, 1},      {-5, 0, 1}};
    const std::vector<std::uint32_t> hashes{0, 1, 2, 11, 18, 18, 23, 16};
    const Hashed got = Hasher(report.device, lesson, points.size())(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (got.hashes[k] != hashes[k])
            report.fail("hash of " + ballAt(k, points[k]), text(got.hashes[k]), text(hashes[k]));
        if (got.indices[k] != k)
            report.fail("index of ball " + text(k), text(got.indices[k]), text(k));
    }
    if (got.outside != 1) report.fail("balls counted as outside", text(got.outside), "1");
    guessMistake(report, lesson, points, got);
}

void faces(Report& report) {
    std::vector<Vec3> points;
    for (float x = -8; x <= 8; x += 2)
        for (float y = -6; y <= 6; y += 2)
            for (float z = -4; z <= 4; z += 2)
                for (const float shift : {-0.25f, 0.0f, 0.25f})
                    points.push_back({x + shift, y + shift, z + shift});
    Hasher hash(report.device, aroundZero, points.size());
    requireRight(report, hash, aroundZero, points);
}

void outside(Report& report) {
    // One by one, so that a wrong count has a culprit.
    std::vector<Vec3> points{{0, 0, 0},          {-9, 1, 1},        {9, 1, 1},    {1, -7, 1},
                             {1, 7, 1},          {1, 1, -5},        {1, 1, 5},    {-9, -7, -5},
                             {9, 7, 5},          {-30, 1, 1},       {30, 30, 30}, {1e30f, 1, 1},
                             {1, -1e30f, 1e30f}, {1, notANumber, 1}};
    for (const Vec3 p : randomPoints(50, {{-10, -8, -6}, {10, 8, 6}}, report.seed))
        points.push_back(p);
    sameElements(report, placesOneByOne(report.device, aroundZero, points),
                 placesOf(aroundZero, points), [&](std::size_t k) { return ballAt(k, points[k]); });
    Hasher hash(report.device, aroundZero, points.size());
    guessMistake(report, aroundZero, points, hash(points));
    drawIfWrong(report);
}

void neighbours(Report& report) {
    const std::vector<Vec3> points =
        randomPoints(1000, {{-8, -6, -4}, {5.9f, 3.9f, 1.9f}}, report.seed + 1);
    Hasher hash(report.device, aroundZero, points.size());
    const std::vector<std::uint32_t> here = hash(points).hashes;
    const auto requireStep = [&](Vec3 step, std::uint32_t distance, const char* axis) {
        std::vector<Vec3> moved;
        for (const Vec3 p : points) moved.push_back(p + step);
        const std::vector<std::uint32_t> there = hash(moved).hashes;
        for (std::size_t k = 0; k < points.size(); ++k) {
            // A ball that the addition rounds across a face is no evidence.
            const bool exact = moved[k] - step == points[k];
            if (exact && there[k] - here[k] != distance)
                report.fail(ballAt(k, points[k]) + ", one cell on along " + axis,
                            "hash changed by " + text(static_cast<int>(there[k] - here[k])),
                            "by " + text(distance));
        }
    };
    requireStep({2, 0, 0}, 1, "x");
    requireStep({0, 2, 0}, 8, "y");
    requireStep({0, 0, 2}, 48, "z");
    guessMistake(report, aroundZero, points, hash(points));
    drawIfWrong(report);
}

/// Pairs of points that touch if their balls have diameter `world.cellSize`, in and around it.
std::vector<std::pair<Vec3, Vec3>> touchingPairs(const World& world, std::uint64_t seed) {
    const float d = world.cellSize;
    const Bounds wide{world.bounds.lower - Vec3{d, d, d}, world.bounds.upper + Vec3{d, d, d}};
    const Bounds near{{-d / 2, -d / 2, -d / 2}, {d / 2, d / 2, d / 2}};
    std::vector<std::pair<Vec3, Vec3>> pairs;
    for (const Vec3 p : randomPoints(1000, wide, seed))
        for (const Vec3 step : {Vec3{d, 0, 0}, Vec3{0, d, 0}, Vec3{0, 0, d}})
            pairs.push_back({p, p + step});
    for (const Vec3 p : randomPoints(1000, wide, seed + 1))
        pairs.push_back({p, p + randomPoints(1, near, seed + pairs.size())[0]});
    return pairs;
}

void touching(Report& report) {
    const World world{{{-4, -4, -4}, {7, 7, 7}}, 1.1f, {10, 10, 10}};
    auto pairs = touchingPairs(world, report.seed);
    // Without the hair in UniformGrid these two touch and are two cells apart: 2.9999998 and 4.
    pairs.push_back({{-0.7f, 0, 0}, {0.4f, 0, 0}});
    std::vector<Vec3> points;
    for (const auto& [a, b] : pairs) points.push_back(a), points.push_back(b);
    Hasher hash(report.device, world, points.size(), WithHair{});
    const std::vector<std::uint32_t> hashes = hash(points).hashes;
    const std::vector<Int3> cells = cellsInOrder(world.resolution);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const std::uint32_t one = hashes[2 * k], other = hashes[2 * k + 1];
        const std::string who = "cells of balls at " + text(pairs[k].first) + " and " +
                                text(pairs[k].second) + ", which touch";
        if (one >= cells.size() || other >= cells.size()) {
            report.fail(who, "numbers " + text(one) + " and " + text(other), "below 1000");
            continue;
        }
        const Int3 a = cells[one], b = cells[other];
        const int most = std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
        if (most > 1) report.fail(who, text(a) + " and " + text(b), "at most one apart");
    }
    report.guess({{"cells half as large as asked: chapter 06 looks one cell far, not two",
                   [] { return cellAlongAxis(1, 0, 0.5f, 8) == 1; }}});
    drawIfWrong(report);
}

void randomScenes(Report& report) {
    // One set of arrays for all, the largest scene first: what is not written again is stale.
    Hasher hash(report.device, aroundZero, 1000);
    for (const int count : {1000, 257, 256, 255, 33, 2, 1, 0})
        requireRight(report, hash, aroundZero,
                     randomPoints(count, {{-9, -7, -5}, {9, 7, 5}}, report.seed + count));
    requireRight(report, hash, aroundZero, std::vector<Vec3>(33, {-1, -1, -1}));
    drawIfWrong(report);
    std::map<std::uint32_t, int> population;
    for (const Vec3 p : randomPoints(192, aroundZero.bounds, report.seed))
        ++population[placeOf(aroundZero, p).hash];
    int fullest = 0;
    for (const auto& [cell, count] : population) fullest = std::max(fullest, count);
    if (report.device == Device::cpu)
        report.measured("192 balls at random in 192 cells: " + text(192 - population.size()) +
                        " cells stay empty, the fullest holds " + text(fullest) + " balls");
}

void anyOrder(Report& report) {
    const std::vector<Vec3> points =
        randomPoints(6000, {{-10, -10, -10}, {10, 10, 10}}, report.seed + 5);
    Hasher hash(report.device, aroundZero, points.size());
    inEveryOrder(report, [&] { return hash(points); });

    const std::vector<Vec3> outside =
        randomPoints(400000, {{-50, -50, -50}, {-9, 50, 50}}, report.seed + 6);
    Hasher many(report.device, aroundZero, outside.size());
    const auto [got, contention] = many.countContended(outside);
    const std::uint32_t expected =
        static_cast<std::uint32_t>(contention.launches) * countedByOneThread(aroundZero, outside);
    if (got == expected) {
        if (!contention.happened)
            report.measured(
                "threads never ran at once here: counting was not put to the test. Run "
                "the check again when the machine is idle");
        return;
    }
    report.racy("one thread counts " + text(expected) + " balls outside, many threads " +
                text(got));
    report.guess(
        {{"a count that is not atomic: two threads read the same number, and one ball is "
          "lost (fetchAdd in common/atomics.cuh)",
          [got = got, expected] { return got < expected; }}});
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "02",
        {{"hash.axis", "A coordinate lies in the cell whose lower face it passed last",
          "Otherwise balls on both sides of zero, or of the lower wall, share a cell that is two "
          "cells wide, and the search around it misses pairs.",
          axisByHand},
         {"hash.clamp", "The nearest index that exists is the first, the last, or the index itself",
          "An index beyond the last cell writes past the end of an array.", clampByHand},
         {"hash.number", "Cells are numbered along x first, then y, then z",
          "Chapter 06 reads three cells of a row as one run of memory. It can because their "
          "numbers follow each other.",
          numberByHand},
         {"hash.inverse", "From a cell's number its coordinates come back",
          "Chapter 06 knows of a ball only the number of its cell, and must find those around it.",
          inverse},
         {"hash.write", "Every ball gets its hash and its own slot; those outside are counted",
          "Chapter 03 sorts the hashes and carries the slots along. A slot that is not written "
          "sends another ball's data along.",
          writeByHand},
         {"hash.faces", "A ball on a face, an edge or a corner belongs to the cell above",
          "Scenes made by people put balls on round numbers, which is where the faces are.", faces},
         {"hash.outside", "A ball outside the world gets the nearest cell, and is counted",
          "Clamping never moves two cells apart, so balls outside still meet all neighbours. The "
          "count tells you that balls escape.",
          outside},
         {"hash.neighbours", "One cell on along x, y or z the hash grows by 1, Rx or Rx * Ry",
          "The search in chapter 06 reaches the cells around a ball by adding these numbers.",
          neighbours},
         {"hash.touching", "Balls no larger than a cell that touch are at most one cell apart",
          "Chapter 06 looks one cell far. A pair that is two cells apart is never found.",
          touching},
         {"hash.random", "Whatever lay in the arrays, every ball gets the right hash and slot",
          "What no one thought of, and what an earlier run left behind.", randomScenes},
         {"hash.order", "The result does not depend on the order of the threads",
          "A GPU promises no order, and a sum that two threads change at once loses a part.",
          anyOrder}});
}
