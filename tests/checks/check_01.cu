// Checks of chapter 01: threads, blocks, and which balls touch.
#include "tests/checks/check_01_rush.cuh"
#include "tests/checks/check_01_scenes.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

GridIndex at(int x) { return {static_cast<unsigned>(x), 0, 0}; }

// ---- the checks

void touchByHand(Report& report) {
    struct Row {
        Vec4 a, b;
        bool touch;
        const char* where;
    };
    const std::vector<Row> rows{
        {{0, 0, 0, 0.5f}, {0.75f, 0, 0, 0.5f}, true, "overlapping along x"},
        {{0, 0, 0, 0.5f}, {0, 1.25f, 0, 0.5f}, false, "apart along y"},
        {{0, 0, 0, 0.5f}, {0, 0, 1, 0.5f}, false, "exactly at contact"},
        {{0, 0, 0, 2}, {3, 0, 4, 3.5f}, true, "distance 5, radii 2 and 3.5"},
        {{0, 0, 0, 3.5f}, {3, 4, 0, 2}, true, "distance 5, radii 3.5 and 2"},
        {{0, 0, 0, 0.25f}, {0.6f, 0, 0, 0.25f}, false, "two small balls, 0.6 apart"},
        {{0, 0, 0, 4}, {3, 4, 12, 8.5f}, false, "distance 13, radii 4 and 8.5"},
        {{-2, -3, -4, 0.5f}, {-2.5f, -3.5f, -4.5f, 0.5f}, true, "negative coordinates"},
        {{-1, 0, 0, 0.75f}, {1, 0, 0, 0.75f}, false, "on both sides of zero"},
        {{1, 2, 3, 0.1f}, {1, 2, 3, 0.2f}, true, "the same centre"},
        {{0, 0, 0, 5}, {1, 1, 0, 0.125f}, true, "one inside the other"},
        {{1, 2, 3, 0}, {1, 2, 3, 0}, false, "two points"}};
    const auto same = [&](Rule wrong) {
        return [&rows, wrong] {
            return std::all_of(rows.begin(), rows.end(), [wrong](const Row& row) {
                return spheresTouch(row.a, row.b) == wrong(row.a, row.b);
            });
        };
    };
    for (const Row& row : rows)
        if (spheresTouch(row.a, row.b) != row.touch)
            report.fail("touch of two balls (" + std::string(row.where) + ")", text(!row.touch),
                        text(row.touch));
    report.guess(
        {{"<= in place of <: at exactly the sum of the radii, two balls do not touch",
          same(alsoAtContact)},
         {"only one of the two radii: balls touch at the sum of both", same(ownRadius)},
         {"only one of the two radii: balls touch at the sum of both", same(otherRadius)},
         {"radii squared one by one: the sum must be squared as a whole", same(radiiSquared)},
         {"a squared distance compared with a distance: square the sum of the radii, too",
          same(notSquared)},
         {"a distance compared with a squared sum: leave out the root", same(rootForgotten)}});
}

struct BlockRow {
    int count, threads, blocks;
};
constexpr BlockRow blockRows[] = {{0, 256, 0},   {1, 256, 1},    {255, 256, 1}, {256, 256, 1},
                                  {257, 256, 2}, {1000, 256, 4}, {6, 3, 2},     {7, 3, 3},
                                  {5, 1, 5},     {8, 32, 1},     {1024, 32, 32}};

void blocksByHand(Report& report) {
    const auto same = [](int (*wrong)(int, int)) {
        return [wrong] {
            return std::all_of(std::begin(blockRows), std::end(blockRows), [wrong](BlockRow row) {
                return blockCountFor(row.count, row.threads) == wrong(row.count, row.threads);
            });
        };
    };
    for (const BlockRow row : blockRows) {
        const int blocks = blockCountFor(row.count, row.threads);
        if (blocks != row.blocks)
            report.fail(
                "blocks of " + text(row.threads) + " threads for " + text(row.count) + " balls",
                text(blocks), text(row.blocks));
    }
    report.guess({{"rounded down: the balls of the last, half-filled block have no thread",
                   same([](int count, int threads) { return count / threads; })},
                  {"one block too many where the balls fill the last block",
                   same([](int count, int threads) { return count / threads + 1; })},
                  {"one block too many where the balls fill the last block",
                   same([](int count, int threads) { return (count + threads) / threads; })}});
}

struct ThreadRow {
    int block, threads, thread, number;
};
constexpr ThreadRow threadRows[] = {{0, 256, 0, 0},   {0, 256, 255, 255}, {1, 256, 0, 256},
                                    {2, 256, 5, 517}, {6, 7, 1, 43},      {3, 1, 0, 3}};

void threadByHand(Report& report) {
    const auto same = [](int (*wrong)(ThreadRow)) {
        return [wrong] {
            return std::all_of(
                std::begin(threadRows), std::end(threadRows), [wrong](ThreadRow row) {
                    return threadNumber(at(row.block), at(row.threads), at(row.thread)) ==
                           wrong(row);
                });
        };
    };
    for (const ThreadRow row : threadRows) {
        const int number = threadNumber(at(row.block), at(row.threads), at(row.thread));
        if (number != row.number)
            report.fail("number of thread " + text(row.thread) + " of block " + text(row.block) +
                            ", blocks of " + text(row.threads),
                        text(number), text(row.number));
    }
    report.guess({{"the block is left out: every block does the work of the first",
                   same([](ThreadRow row) { return row.thread; })},
                  {"block and thread exchanged: whole blocks lie before this one, not threads",
                   same([](ThreadRow row) { return row.thread * row.threads + row.block; })}});
}

/// A row of balls 1 m apart whose radii make each touch the next and the next but one.
Balls rowOfBalls(int count) {
    Balls balls;
    for (int k = 0; k < count; ++k) balls.push_back({float(k), 0, 0, 1.25f});
    return balls;
}

/// How many pairs one thread finds: blocks of 4 threads, 10 balls in a row, and behind them in
/// memory two more that touch everything.
std::uint32_t foundByThread(int thread) {
    Balls balls = rowOfBalls(10);
    balls.resize(12, Vec4{0, 0, 0, 1e6f});
    auto positions = uploaded(Device::cpu, balls, "positions");
    DeviceBuffer<Pair> pairs(Device::cpu, 100, "pairs");
    DeviceBuffer<std::uint32_t> found(Device::cpu, 1, "found");
    found.fill(0);
    findPairsNaive(at(thread / 4), at(4), at(thread % 4), 10, positions.view(), pairs.view(),
                   found.view());
    return found.download()[0];
}

void guardByHand(Report& report) {
    for (int thread = 0; thread < 12; ++thread) {
        const std::uint32_t got = foundByThread(thread);
        const auto expected = static_cast<std::uint32_t>(thread < 10 ? std::min(thread, 2) : 0);
        if (got != expected)
            report.fail("pairs found by thread " + text(thread) + " of 12, for 10 balls", text(got),
                        text(expected));
    }
    report.guess({{"no guard: threads without a ball take what lies behind the balls in memory",
                   [] { return foundByThread(10) > 0 && foundByThread(11) > 0; }},
                  {"> in place of >=: ten balls have the numbers 0 to 9",
                   [] { return foundByThread(10) > 0 && foundByThread(11) == 0; }}});
}

void loopByHand(Report& report) {
    const Balls balls = rowOfBalls(6);
    auto positions = uploaded(Device::cpu, balls, "positions");
    std::vector<Pair> all;
    for (int i = 0; i < 6; ++i) {
        DeviceBuffer<Pair> pairs(Device::cpu, 36, "pairs");
        DeviceBuffer<std::uint32_t> found(Device::cpu, 1, "found");
        found.fill(0);
        findPartners(i, positions.view(), pairs.view(), found.view());
        const std::vector<Pair> got = pairs.download(std::min(found.download()[0], 36u));
        std::vector<Pair> expected;
        for (int other = std::max(i - 2, 0); other < i; ++other)
            expected.push_back(pairOf(other, i));
        samePairs(report, got, expected, [&](Pair p) {
            return describe(balls, p) + ", when ball " + text(i) + " looks at those before it";
        });
        all.insert(all.end(), got.begin(), got.end());
    }
    if (report.failed()) guessMistake(report, balls, sorted(all));
}

void appendByHand(Report& report) {
    // A list of 3 places, in which five pairs are appended; the fourth place is not ours.
    DeviceBuffer<Pair> pairs(Device::cpu, 4, "pairs");
    DeviceBuffer<std::uint32_t> found(Device::cpu, 1, "found");
    pairs.fill(0xFF);
    found.fill(0);
    View<Pair> list = pairs.view();
    list.count = 3;
    for (int k = 1; k <= 5; ++k) {
        appendPair(pairOf(0, k), list, found.view());
        if (found.download()[0] != static_cast<std::uint32_t>(k))
            report.fail("pairs counted after " + text(k) + " were appended to a list of 3 places",
                        text(found.download()[0]), text(k));
    }
    const std::vector<Pair> got = pairs.download();
    for (int k = 0; k < 4; ++k) {
        const Pair expected = k < 3 ? pairOf(0, k + 1) : untouched;
        if (!(got[std::size_t(k)] == expected))
            report.fail("place " + text(k) + " of the list", text(got[std::size_t(k)]),
                        k < 3 ? text(expected) : "untouched: it lies behind the list");
    }
    report.guess({{"only stored pairs are counted: nobody learns that the list was too short",
                   [&] { return found.download()[0] == 3; }}});
}

/// Each thread leaves a mark on its number.
HD void markNumber(GridIndex blockIdx, GridIndex blockDim, GridIndex threadIdx,
                   View<std::uint32_t> marks) {
    const int number = threadNumber(blockIdx, blockDim, threadIdx);
    if (number >= 0 && static_cast<std::uint32_t>(number) < marks.count) fetchAdd(marks[number], 1);
}

#ifdef __CUDACC__
__global__ void markNumberKernel(View<std::uint32_t> marks) {
    markNumber(blockIdx, blockDim, threadIdx, marks);
}
#endif

void markNumbers(Device device, int blocks, int threads, View<std::uint32_t> marks) {
    if (device == Device::cpu) return emulateGrid<markNumber>(blocks, threads, marks);
#ifdef __CUDACC__
    markNumberKernel<<<blocks, threads, 0, cudaStream>>>(marks);
    checkCuda(cudaGetLastError(), "markNumberKernel");
#endif
}

void cover(Report& report) {
    for (const int threads : {1, 3, 7, 32, 33, 255, 256, 257, 1000})
        for (const int count : {1, 2, 33, 255, 256, 257, 1000}) {
            const int blocks = blockCountFor(count, threads);
            const std::string grid = text(blocks) + " blocks of " + text(threads) +
                                     " threads for " + text(count) + " balls";
            if (blocks < 1 || (blocks - 1) * threads >= count) {
                report.fail(grid, text(blocks), "enough blocks, and none without work");
                continue;
            }
            DeviceBuffer<std::uint32_t> marks(report.device, std::size_t(blocks * threads),
                                              "marks");
            marks.fill(0);
            markNumbers(report.device, blocks, threads, marks.view());
            const std::vector<std::uint32_t> times = marks.download();
            for (std::size_t k = 0; k < std::max(times.size(), std::size_t(count)); ++k) {
                const std::uint32_t got = k < times.size() ? times[k] : 0;
                if (got != 1)
                    report.fail("threads with number " + text(k) + " in " + grid, text(got), "1");
            }
        }
}

void oneCentre(Report& report) {
    const Balls balls(33, Vec4{-1, 2, -3, 0.5f});
    Workplace workplace(report.device);
    const Found found = workplace.search(balls);
    for (const Pair p : found.stored)
        if (!(p.first < p.second))
            report.fail("spelling of pair " + text(p), text(p),
                        "smaller number first, no ball with itself");
    requireRightPairs(report, balls, found);  // 33 * 32 / 2 pairs
}

void measureShare(Report& report, std::uint32_t touching) {
    if (touching > 0)
        report.measured("1000 balls, 499500 comparisons: " + text(touching) +
                        " find a touching pair, one in " + text(499500 / touching));
}

void randomScenes(Report& report) {
    Workplace workplace(report.device);
    // Large, small, large again: what one search leaves behind must not reach the next.
    for (const int count : {1000, 0, 1, 2, 33, 255, 256, 257, 1000}) {
        const float side = 0.5f * std::cbrt(static_cast<float>(count));
        const Balls balls = scattered(count, {{-side, -side, -side}, {side, side, side}},
                                      report.seed + static_cast<std::uint64_t>(count));
        const Found found = workplace.search(balls);
        requireRightPairs(report, balls, found);
        if (count == 1000 && report.measurements.empty()) measureShare(report, found.count);
    }
    // Balls on a table, seen from above, for the picture.
    constexpr float side = 17;
    const Balls table = scattered(300, {{0, 0, 0}, {side, 0, side}}, report.seed + 7);
    const Found found = workplace.search(table);
    requireRightPairs(report, table, found);
    if (report.failed())
        report.picture([&] { return drawPairs(table, side, found.stored, sweptPairs(table)); });
}

void full(Report& report) {
    const Balls balls = scattered(300, {{-2, -2, -2}, {2, 2, 2}}, report.seed + 8);
    const std::vector<Pair> expected = sweptPairs(balls);
    const auto needed = static_cast<std::uint32_t>(expected.size());
    Workplace workplace(report.device);
    for (const std::uint32_t capacity : {0u, 1u, 16u, needed - 1, needed, needed + 1}) {
        const Found found = workplace.search(balls, capacity);
        const std::string list =
            "a list of " + text(capacity) + " places for " + text(needed) + " pairs";
        if (found.count != needed)
            report.fail("pairs counted with " + list, text(found.count), text(needed));
        if (found.wroteBeyond) report.fail(list + ": something behind the list was written to");
        for (std::size_t k = 0; k < found.stored.size(); ++k) {
            const Pair p = found.stored[k];
            if (!std::binary_search(expected.begin(), expected.end(), p))
                report.fail("pair " + text(p) + " in " + list, "stored", "no such pair touches");
            if (k > 0 && p == found.stored[k - 1])
                report.fail("pair " + text(p) + " in " + list, "stored twice", "once");
        }
    }
}

void anyOrder(Report& report) {
    appendInACrowd(report);
    if (report.failed()) return;
    const Balls balls = scattered(5000, {{-14, -14, -14}, {14, 14, 14}}, report.seed + 9);
    Workplace workplace(report.device);
    const Found first = inEveryOrder(report, [&] { return workplace.search(balls); });
    if (!report.isRacy) requireRightPairs(report, balls, first);
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "01",
        {{"naive.touch", "Two balls touch if their centres are nearer than the sum of their radii",
          "Every later chapter asks this question. At exactly that distance the answer is no: "
          "balls "
          "that only meet have nothing to push apart.",
          touchByHand},
         {"naive.blocks", "There are just enough blocks: rounded up, and none for no balls",
          "Blocks are whole. Rounded down, the last balls get no thread and are never looked at, "
          "and counts that are multiples of the block size hide it.",
          blocksByHand},
         {"naive.thread", "A thread's number counts all threads of the blocks before its own",
          "It is the only thing that tells one thread from another: it decides which ball is mine.",
          threadByHand},
         {"naive.guard", "A thread without a ball finds nothing",
          "Memory goes on behind the last ball. A thread that reads there finds old balls, or ends "
          "the program. With 256 or 512 balls no such thread exists, and the fault stays hidden.",
          guardByHand},
         {"naive.loop", "Ball i is compared with the balls 0 to i - 1, and with no other",
          "So each two balls meet once. A pair that is listed twice is pushed twice.", loopByHand},
         {"naive.append", "Every pair is counted, and those for which there is room are stored",
          "The count tells the caller how long the list must be. A list that is silently cut lets "
          "balls fall through each other.",
          appendByHand},
         {"naive.cover", "In a grid of any block size, each ball has exactly one thread",
          "The block size is a matter of speed. It must never change the answer.", cover},
         {"naive.once", "Balls in one place: each two are a pair once, smaller number first",
          "n balls have n (n - 1) / 2 pairs. No other scene is so sure to show one too many.",
          oneCentre},
         {"naive.random", "Random scenes: the same pairs as a slow search along one axis",
          "What no one thought of, with arrays that still hold what the search before has left.",
          randomScenes},
         {"naive.full", "A list that is too short is filled to its end, and not beyond",
          "What lies behind a list belongs to someone else.", full},
         {"naive.order", "No pair is lost, in whatever order and however many threads append",
          "Read, add one, write back: if two threads read the same number, both write to one place "
          "and one pair is gone.",
          anyOrder}});
}
