// Checks of chapter 04: bodies in cell order.
#include "04_reorder/reorder.cuh"

#include "02_grid_hash/grid_hash.cuh"
#include "common/algorithms.h"
#include "tests/checks/canvas.h"
#include "tests/checks/check_04_bodies.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

constexpr Bounds room{{0, 0, 0}, {12, 12, 12}};
constexpr int counts[] = {0, 1, 2, 33, 255, 256, 257, 1000};

/// The lesson's five balls. By cell: ball 1, then 4, then 0, then 2 and 3.
//@show five_balls
const Bodies fiveBalls{
    // x, y, z, radius     vx, vy, vz, 1/mass    e     id
    {{3.1f, 1.5f, 2.0f, 0.5f}, {1, 0, 0, 1.0f}, 0.9f, 0},  // in cell 33
    {{1.2f, 0.5f, 0.4f, 0.4f}, {2, 0, 0, 2.0f}, 0.8f, 1},  // in cell 5
    {{2.6f, 2.5f, 2.7f, 0.3f}, {3, 0, 0, 4.0f}, 0.7f, 2},  // in cell 42
    {{2.9f, 2.6f, 2.5f, 0.2f}, {4, 0, 0, 0.5f}, 0.6f, 3},  // in cell 42, too
    {{2.4f, 2.7f, 0.6f, 0.1f}, {5, 0, 0, 8.0f}, 0.5f, 4},  // in cell 10
};
const Order sortedFive{1, 4, 0, 2, 3};
//@end

// ---- the checks

void byHand(Report& report) {
    const Bodies got = gathered(report.device, sortedFive, fiveBalls);
    const Bodies expected{{{1.2f, 0.5f, 0.4f, 0.4f}, {2, 0, 0, 2.0f}, 0.8f, 1},
                          {{2.4f, 2.7f, 0.6f, 0.1f}, {5, 0, 0, 8.0f}, 0.5f, 4},
                          {{3.1f, 1.5f, 2.0f, 0.5f}, {1, 0, 0, 1.0f}, 0.9f, 0},
                          {{2.6f, 2.5f, 2.7f, 0.3f}, {3, 0, 0, 4.0f}, 0.7f, 2},
                          {{2.9f, 2.6f, 2.5f, 0.2f}, {4, 0, 0, 0.5f}, 0.6f, 3}};
    if (!requireSame(report, got, expected)) guessMistake(report, sortedFive, fiveBalls, got);
}

void again(Report& report) {
    // As after the first step: body k no longer lies in slot k.
    const Bodies inCells = dealt(sortedFive, fiveBalls);
    const Order next{1, 2, 0, 4, 3};
    const Bodies got = gathered(report.device, next, inCells);
    const std::vector<std::uint32_t> ids{4, 0, 1, 3, 2};
    for (std::size_t k = 0; k < ids.size(); ++k)
        if (got[k].id != ids[k])
            report.fail("id in slot " + text(k) + " after the second sort", text(got[k].id),
                        text(ids[k]));
    if (!requireSame(report, got, dealt(next, inCells))) guessMistake(report, next, inCells, got);
}

template <class T>
std::vector<T> returned(Device device, const std::vector<std::uint32_t>& ids,
                        const std::vector<T>& slots) {
    auto idsThere = uploaded(device, ids, "ids");
    auto slotsThere = uploaded(device, slots, "slots");
    auto byBody = uploaded(device, std::vector<T>(slots.size()), "byBody");
    launch<returnToBodies<T>>(device, static_cast<int>(slots.size()),
                              View<const std::uint32_t>(idsThere.view()),
                              View<const T>(slotsThere.view()), byBody.view());
    return byBody.download();
}

void back(Report& report) {
    const std::vector<std::uint32_t> inSlots{20, 50, 10, 30, 40}, expected{10, 20, 30, 40, 50};
    const auto body = [](std::size_t k) { return "value of body " + text(k); };
    const auto got = returned(report.device, sortedFive, inSlots);
    if (!sameElements(report, got, expected, body))
        report.guess({{"a gather for a scatter: slot i must give its value to body ids[i]", [&] {
                           return got == std::vector<std::uint32_t>{50, 40, 20, 10, 30};
                       }}});
}

void bytes(Report& report) {
    const std::size_t got = bytesMovedPerBody();
    if (got == 84) return;
    report.fail("bytes moved for one body", text(got), "84");
    report.guess({{"the fields counted once: each is read and written", [&] { return got <= 44; }},
                  {"the index left out: it is read as well", [&] { return got == 80; }},
                  {"three floats for a position: w makes it four", [&] { return got == 68; }}});
}

void sameBodies(Report& report) {
    for (const int count : counts) {
        const Bodies bodies = randomBodies(count, room, report.seed);
        std::vector<int> seen(bodies.size());
        for (const Body& body :
             gathered(report.device, randomOrder(count, report.seed + 1), bodies)) {
            if (body.id < seen.size())
                ++seen[body.id];
            else
                report.fail("an id among " + text(count) + " bodies", text(body.id),
                            "below " + text(count));
        }
        for (std::size_t id = 0; id < seen.size(); ++id)
            if (seen[id] != 1)
                report.fail("body " + text(id) + " of " + text(count),
                            text(seen[id]) + " times in memory", "once");
    }
}

void dataFollow(Report& report) {
    for (const int count : counts) {
        const Bodies bodies = randomBodies(count, room, report.seed + 2);
        requireRightOrder(report, randomOrder(count, report.seed + 3), bodies);
    }
}

void undone(Report& report) {
    Bodies bodies = randomBodies(1000, room, report.seed + 4);
    bodies[7].position = {-0.0f, 1e-42f, 3e38f, 0.0f};  // -0, a denormal, nearly the largest
    Bodies got = gathered(report.device, randomOrder(1000, report.seed + 5), bodies);
    std::vector<std::uint32_t> ids;
    std::vector<Vec4> positions, velocities;
    for (const Body& body : got) {
        // Behind a wrong gather an id may be anything; it must not lead out of the array.
        ids.push_back(body.id % 1000);
        positions.push_back(body.position);
        velocities.push_back(body.velocity);
    }
    positions = returned(report.device, ids, positions);
    velocities = returned(report.device, ids, velocities);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        if (!same(positions[k], bodies[k].position))
            report.fail("position of body " + text(k), inWords(positions[k], "radius"),
                        inWords(bodies[k].position, "radius"));
        if (!same(velocities[k], bodies[k].velocity))
            report.fail("velocity of body " + text(k), inWords(velocities[k], "1/mass"),
                        inWords(bodies[k].velocity, "1/mass"));
    }
}

void usedAgain(Report& report) {
    constexpr int capacity = 600, count = 500;
    Arrays from(report.device, capacity), to(report.device, capacity);
    for (std::uint64_t frame = 0; frame < 3; ++frame) {
        const Bodies bodies = randomBodies(capacity, room, report.seed + 6 + frame);
        const Order order = randomOrder(count, report.seed + 9 + frame);
        const Bodies before = to.download();
        from.upload(bodies);
        gather(report.device, order, from, to);
        Bodies expected = dealt(order, bodies);
        expected.insert(expected.end(), before.begin() + count, before.end());
        requireSame(report, to.download(), expected);
        if (!(from.download() == bodies))
            report.fail("frame " + text(frame) +
                        ": `from` was changed, while other threads still read it");
    }
}

/// Hashes and sorts with the finished pieces: where each slot's body comes from, in cell order.
Order cellOrder(Device device, Bounds world, float cellSize, const Bodies& bodies,
                std::vector<std::uint32_t>& sortedHashes) {
    UniformGrid grid(device, world, cellSize, static_cast<int>(bodies.size()));
    Arrays arrays(device, bodies);
    DeviceBuffer<StepStatus> status(device, 1, "status");
    Scratch scratch(device, 0, "scratch");
    status.fill(0);
    const int count = static_cast<int>(bodies.size());
    launch<computeGridHash>(device, count, grid.view(), View<const Vec4>(arrays.view().positions),
                            grid.hashes.view(), grid.indices.view(), status.view());
    sortPairs(device, count, grid.hashBits(), grid.hashes.data(), grid.indices.data(),
              grid.sortedHashes.data(), grid.sortedIndices.data(), scratch);
    sortedHashes = grid.sortedHashes.download();
    return grid.sortedIndices.download();
}

/// Mean distance in m of two bodies that follow each other in memory.
float meanStep(const Bodies& bodies) {
    double sum = 0.0;
    for (std::size_t k = 1; k < bodies.size(); ++k)
        sum += length(xyz(bodies[k].position) - xyz(bodies[k - 1].position));
    return static_cast<float>(sum / static_cast<double>(bodies.size() - 1));
}

/// Yours, reference, errors: a line through one layer of balls in the order of memory.
Frame drawMemory(Bounds world, const Bodies& got, const Bodies& expected) {
    const auto draw = [&](Canvas& canvas, const Panel& panel, int k) {
        const Bodies& bodies = k == 0 ? got : expected;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const float share = static_cast<float>(i) / static_cast<float>(bodies.size());
            const Vec3 color =
                k == 2 ? colors::line : Vec3{0.15f + 0.75f * share, 0.45f, 0.85f - 0.7f * share};
            const Vec3 here = xyz(bodies[i].position);
            const Vec3 next = xyz(bodies[std::min(i + 1, bodies.size() - 1)].position);
            if (!contains(world, here) || !contains(world, next)) continue;
            canvas.line(panel.x(here.x), panel.y(here.z), panel.x(next.x), panel.y(next.z), 1.5f,
                        color);
            const bool wrong = k == 2 && !(got[i] == expected[i]);
            canvas.disc(panel.x(here.x), panel.y(here.z), wrong ? 3.5f : 2.5f,
                        wrong ? colors::red : color);
        }
    };
    return threePanels(world.lower.x, world.lower.z, extent(world).x, 300, draw);
}

void near(Report& report) {
    std::vector<std::uint32_t> hashes;
    const Bodies bodies = randomBodies(1000, room, report.seed + 12);
    const Order order = cellOrder(report.device, room, 1.5f, bodies, hashes);
    const Bodies got = gathered(report.device, order, bodies);
    const float before = meanStep(bodies), after = meanStep(got);
    if (!(after < 0.5f * before))
        report.fail("mean distance from slot to slot, in m", text(after),
                    "less than half of the " + text(before) + " in random order");
    char answer[96];
    std::snprintf(
        answer, sizeof answer,
        "from one slot to the next it is %.1f m on average before the gather, %.1f m after", before,
        after);
    report.measured(answer);

    // One flat layer, for the picture.
    const Bounds flat{{0, 0, 0}, {12, 1.5f, 12}};
    const Bodies layer = randomBodies(200, flat, report.seed + 13);
    const Order layerOrder = cellOrder(report.device, flat, 1.5f, layer, hashes);
    const Bodies gotLayer = gathered(report.device, layerOrder, layer);
    const Bodies expected = dealt(layerOrder, layer);
    if (requireSame(report, gotLayer, expected)) return;
    guessMistake(report, layerOrder, layer, gotLayer);
    report.picture([&] { return drawMemory(flat, gotLayer, expected); });
}

void anyOrder(Report& report) {
    const Bodies bodies = randomBodies(6000, room, report.seed + 14);
    const Order order = randomOrder(6000, report.seed + 15);
    inEveryOrder(report, [&] { return gathered(report.device, order, bodies); });
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "04",
        {{"reorder.by_hand", "Five balls: slot i holds the ball that the sort put there",
          "From here on every kernel reads slot i and trusts that its cell is sorted hash i.",
          byHand},
         {"reorder.again", "After a second sort, ids still name the bodies, not the slots",
          "The engine sorts anew in every step. Who confuses the two is right once.", again},
         {"reorder.back", "A value by slot comes back to its body",
          "Users number their balls. What they get back must not depend on how memory is sorted.",
          back},
         {"reorder.bytes", "The bytes of one body: its index, and four fields read and written",
          "The gather computes nothing, so bytes a second are its speed.", bytes},
         {"reorder.same_bodies", "Afterwards every body is in memory once",
          "A body that is there twice hits itself; one that is not there has vanished.",
          sameBodies},
         {"reorder.follow", "All four fields of a body go to the same slot",
          "A ball with the velocity, radius or mass of another is a bug that looks like physics.",
          dataFollow},
         {"reorder.undone", "There and back again, every bit is as it was",
          "Moving is not computing: nothing may be rounded.", undone},
         {"reorder.used_again",
          "With other data in the same arrays, nothing of before is left, and "
          "`from` is not touched",
          "The engine uses its arrays in turn. A step that fails starts again from `from`.",
          usedAgain},
         {"reorder.near", "Neighbours in memory are neighbours in space",
          "This is what the gather is for: a thread's neighbours are in the same cache lines.",
          near},
         {"reorder.order", "The result does not depend on the order of the threads",
          "Who sorts in place overwrites bodies that other threads have yet to read.", anyOrder}});
}
