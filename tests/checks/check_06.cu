// Checks of chapter 06: the list of touching pairs. The grids are built by the pieces of chapters
// 02 to 05; the oracle compares every ball with every other.
#include "10_full_system/physics_simulator.cuh"
#include "tests/checks/check_06_cells.cuh"
#include "tests/checks/check_06_parts.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

constexpr int counted[] = {0, 1, 2, 33, 255, 256, 257, 1000};

Scene06 randomScene(int count, float crowding, std::uint64_t seed) {
    const float half = std::cbrt(static_cast<float>(count) / crowding) / 2;
    const Bounds box{{-half, -half, -half}, {half + 0.1f, half + 0.1f, half + 0.1f}};
    return {text(count) + " balls", scattered(count, box, 0.2f, 0.5f, seed), box};
}

void once(Report& report) {
    for (const int count : counted) {
        const Scene06 scene = count == 33 ? crowd(33) : randomScene(count, 8, report.seed + 1);
        Ground ground(report.device, scene);
        requireOrdered(report, found(report.device, ground), " of " + scene.name);
    }
}

Balls ballsOf(const Scene& scene) {
    Balls balls;
    for (std::size_t k = 0; k < scene.spheres.count(); ++k)
        balls.push_back(withW(scene.spheres.positions[k], scene.spheres.radii[k]));
    return balls;
}

/// Cells of a share of the diameter: with smaller ones, exactly the pairs that reach over more than
/// one cell are missed, and the engine refuses them. Returns how many pairs were found.
std::size_t foundWithCells(Report& report, float share, const Scene& scene) {
    const std::string cells = "cells of " + metres(share);
    Ground ground(report.device, {cells, ballsOf(scene), scene.bounds, share});
    const Pairs all = touchingPairs(ground.balls);
    const Pairs near = only(
        all, [&](Pair p) { return areNeighbours(ground.cells[p.first], ground.cells[p.second]); });
    const Found got = found(report.device, ground);
    requirePairs(report, ground, got, share < 1 ? near : all, " (" + cells + ")");
    SimulatorSettings settings = settingsFor(scene, report.device);
    settings.cellSize = share;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    bool refused = false;
    try {
        simulator.step();
    } catch (const InputError&) {
        refused = true;
    }
    if (refused != (share < 1))
        report.fail("the engine with " + cells + " for balls of 1 m", refused ? "refused" : "ran",
                    refused ? "runs" : "refuses");
    return got.stored.size();
}

void complete(Report& report) {
    for (const Scene06& scene : hardScenes(report.seed)) {
        Ground ground(report.device, scene);
        requirePairs(report, ground, found(report.device, ground), touchingPairs(ground.balls),
                     " (" + scene.name + ")");
        if (report.failed()) return;
    }
    const Scene pile = makePile(1000, report.seed);
    std::string answer = "a pile of 1000 balls of 1 m. Pairs found:";
    for (const float share : {0.5f, 0.9f, 1.0f, 1.1f})
        answer += " " + text(foundWithCells(report, share, pile)) + " with cells of " +
                  metres(share) + (share < 1.1f ? "," : "");
    report.measured(answer);
}

void randomScenes(Report& report) {
    const Scene06 flat = table(report.seed + 3);
    Ground ground(report.device, flat);
    const Found onTable = found(report.device, ground);
    if (!requirePairs(report, ground, onTable, touchingPairs(ground.balls), " (" + flat.name + ")"))
        return report.picture([&] { return drawSearch(flat, onTable.stored); });
    for (const int count : counted) {
        // Two searches in the same arrays: what the first has left must not reach the second.
        Searcher searcher(report.device, static_cast<std::size_t>(count), 20000);
        for (const float crowding : {8.0f, 1.0f}) {
            const Scene06 scene = randomScene(count, crowding, report.seed + 4);
            Ground there(report.device, scene);
            requirePairs(report, there, searcher.search(there), touchingPairs(there.balls),
                         " (" + scene.name + ")");
        }
    }
}

// ---- capacity, order

/// The engine with a list of 16 pairs for a pile: told how many are needed, it makes room.
void pile(Report& report) {
    Scene scene = makePile(1000, report.seed);
    scene.gravity = {0, 0, 0};  // nothing moves before the search
    for (Vec3& velocity : scene.spheres.velocities) velocity = {0, 0, 0};
    const Pairs right = touchingPairs(ballsOf(scene));
    SimulatorSettings settings = settingsFor(scene, report.device);
    settings.iterations = 1;
    settings.pairCapacity = 16;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    const std::size_t reported = 16 + simulator.step().overflow;
    if (reported != right.size())
        return report.fail("pairs needed by a pile of 1000 balls, as the host was told",
                           text(reported), text(right.size()));
    report.measured("a pile of 1000 balls: " + text(reported) +
                    " pairs needed, 16 available; after the list has grown, " +
                    text(simulator.lastPairs().size()) + " found");
    samePairs(report, simulator.lastPairs(), right,
              [](Pair) { return std::string(" of the pile, after the list has grown"); });
}

void full(Report& report) {
    Ground ground(report.device, randomScene(300, 6, report.seed + 5));
    const Pairs right = touchingPairs(ground.balls);
    for (const std::size_t capacity : {std::size_t{0}, std::size_t{1}, std::size_t{16},
                                       right.size() - 1, right.size(), right.size() + 1}) {
        const Found got = Searcher(report.device, 300, capacity).search(ground);
        const std::string list =
            " with a list of " + text(capacity) + " for " + text(right.size()) + " pairs";
        if (got.needed != right.size())
            report.fail("pairs reported" + list, text(got.needed), text(right.size()));
        const Pairs prefix(right.begin(),
                           right.begin() + std::ptrdiff_t(std::min(capacity, right.size())));
        sameElements(report, got.stored, prefix,
                     [&](std::size_t k) { return "entry " + text(k) + list; });
    }
    if (!report.failed()) pile(report);
}

void anyOrder(Report& report) {
    Ground ground(report.device, randomScene(5000, 2, report.seed + 6));
    const Found first = inEveryOrder(report, [&] { return found(report.device, ground); });
    if (!report.isRacy)
        requirePairs(report, ground, first, touchingPairs(ground.balls), " (5000 balls)");
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "06",
        {{"pairs.row",
          "A row is searched from the left neighbour to the right, as far as it exists",
          "The number before a row's first cell is the last cell of another row, far away. Balls "
          "there are compared for nothing, and in a narrow world pairs are found twice.",
          rows},
         {"pairs.ranges",
          "Of two balls in neighbouring cells, the first in memory searches, and once",
          "So no pair is missed and none is found twice, and nobody has to look for duplicates.",
          ranges},
         {"pairs.visit", "Exactly the touching balls of the runs are visited, in rising order",
          "The same function counts the pairs and writes them. The two must agree.", visits},
         {"pairs.count", "All partners are counted, the first eight are remembered",
          "From the counts come the places. A count that stops at the memory's end loses pairs.",
          counts},
         {"pairs.report", "The host learns of the first round's pairs and of the most of any round",
          "Several rounds share one list. It must be long enough for the longest.", reports},
         {"pairs.write",
          "Pairs go to the ball's own places; those past the list's end are left out",
          "What lies behind the list belongs to someone else. The count still tells of them.",
          writes},
         {"pairs.find", "Five balls: count, scan, fill gives five pairs in their places",
          "Each of the three steps needs what the one before has written.", wholeList},
         {"pairs.once", "No pair is listed twice, and as many are reported as there are",
          "A pair that is listed twice is pushed twice: the balls fly apart.", once},
         {"pairs.complete", "Hard scenes: the pairs of every ball against every other",
          "Faces, corners, narrow worlds, balls outside: each has cost a public project pairs.",
          complete},
         {"pairs.random", "Random scenes, in arrays that have been used: the same pairs again",
          "What no one thought of, with what the search before has left.", randomScenes},
         {"pairs.full",
          "A list too short is filled to its end, reported, and grown: no pair is lost",
          "A silent cap is the worst of faults: balls fall through each other, and nothing says "
          "why.",
          full},
         {"pairs.order", "The list is the same in whatever order the threads run",
          "Each ball has places of its own, so nobody has to wait, and nothing depends on luck.",
          anyOrder}});
}
