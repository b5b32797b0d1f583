// Checks of chapter 00: the tool chain works, and the kernel's balls lie where they should.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "common/error.h"
#include "common/film.h"
#include "common/metrics.h"
#include "tests/checks/check_00_oracle.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

constexpr int counts[] = {0, 1, 2, 33, 255, 256, 257, 1000};

void requireNearOracle(Report& report, int count, std::uint64_t seed) {
    const Placed placed = placeAll(report.device, count, seed);
    const std::vector<Vec4> expected = oracle(count, seed);
    for (std::size_t k = 0; k < expected.size(); ++k)
        if (!isNear(placed.balls[k], expected[k]))
            report.fail("ball " + text(k) + " of " + text(count), text(placed.balls[k]),
                        text(expected[k]));
    guessMistake(report, placed.balls, seed);
}

// ---- the checks

void sineByHand(Report& report) {
    struct Row {
        std::uint32_t turn;
        float sine;
        const char* where;
    };
    for (const Row& row : {Row{0, 0.0f, "0 degrees"},
                           {357913941, 0.5f, "30 degrees"},
                           {536870912, 0.70710678f, "45 degrees"},
                           {1073741824, 1.0f, "90 degrees"},
                           {2147483648u, 0.0f, "180 degrees"},
                           {3221225472u, -1.0f, "270 degrees"},
                           {3937053355u, -0.5f, "330 degrees"}})
        if (!(std::abs(sineOf(row.turn) - row.sine) <= 1e-5f))
            report.fail(std::string("sine of ") + row.where, text(sineOf(row.turn)),
                        text(row.sine));
    for (std::uint32_t k = 0; k < 1000; ++k) {
        const std::uint32_t turn = k * 4294967u;
        const double angle = wholeTurn * turn / 4294967296.0;
        if (!(std::abs(cosineOf(turn) - std::cos(angle)) <= 1e-5))
            report.fail("cosine of step " + text(turn), text(cosineOf(turn)),
                        text(float(std::cos(angle))));
    }
}

void eightByHand(Report& report) {
    const Placed placed = placeAll(report.device, 8);
    for (std::size_t k = 0; k < 8; ++k) {
        const Vec4 ball = placed.balls[k];
        const float aside = std::sqrt(ball.x * ball.x + ball.z * ball.z);
        const float expected = std::sqrt(float(2 * k + 1)), share = float(2 * k + 1) / 16.0f;
        if (!isNear(aside, expected))
            report.fail("ball " + text(k) + " of 8, metres from the middle", text(aside),
                        "sqrt(" + text(2 * k + 1) + ") = " + text(expected));
        if (!isNear(ball.y - ball.w, 1.7f * (1.0f - share)))
            report.fail("ball " + text(k) + " of 8, metres from the floor to its lowest point",
                        text(ball.y - ball.w), text(1.7f * (1.0f - share)));
        if (!isNear(ball.w, 0.6f + 0.15f * share))
            report.fail("ball " + text(k) + " of 8, its radius in m", text(ball.w),
                        text(0.6f + 0.15f * share));
    }
    if (!isNear(placed.balls[0].x, 1.0f) || !isNear(placed.balls[0].z, 0.0f))
        report.fail("ball 0 of 8, where it begins", text(xyz(placed.balls[0])), "x = 1, z = 0");
    guessMistake(report, placed.balls, 0);
}

void eachOnce(Report& report) {
    constexpr std::size_t spare = 8;
    for (const int count : counts) {
        const std::size_t room = static_cast<std::size_t>(count) + spare;
        DeviceBuffer<Vec4> positions(report.device, room, "positions");
        DeviceBuffer<Vec3> colors(report.device, room, "colors");
        positions.upload(std::vector<Vec4>(room, Vec4{-99, -99, -99, -99}));
        colors.upload(std::vector<Vec3>(room, Vec3{-99, -99, -99}));
        launch<placeBall>(report.device, count, makeHill(std::max(count, 1), 0), positions.view(),
                          colors.view());
        const Placed placed{positions.download(), colors.download()};
        for (std::size_t k = 0; k < room; ++k) {
            const bool isBall = k < static_cast<std::size_t>(count);
            const bool isPlaced = placed.balls[k].w != -99.0f, isColored = placed.colors[k].x >= 0;
            if (isPlaced != isBall || isColored != isBall)
                report.fail("element " + text(k) + " after a launch for " + text(count) + " balls",
                            isPlaced && isColored   ? "written"
                            : isPlaced || isColored ? "written by half"
                                                    : "untouched",
                            isBall ? "written" : "untouched");
        }
    }
}

void usedBuffers(Report& report) {
    DeviceBuffer<Vec4> positions(report.device, 1000, "positions");
    DeviceBuffer<Vec3> colors(report.device, 1000, "colors");
    for (const int count : {1000, 33, 257, 1}) {
        const auto seed = static_cast<std::uint64_t>(count % 16);
        launch<placeBall>(report.device, count, makeHill(count, seed), positions.view(),
                          colors.view());
        const Placed fresh = placeAll(report.device, count, seed);
        Placed again{positions.download(), colors.download()};
        again.balls.resize(fresh.balls.size());
        again.colors.resize(fresh.colors.size());
        if (!(again == fresh))
            report.fail("the balls of a scene of " + text(count), "other bits in used memory",
                        "the bits of fresh memory");
    }
}

void insideBox(Report& report) {
    for (const int count : counts) {
        const std::vector<Vec4> balls = placeAll(report.device, count, report.seed).balls;
        for (std::size_t k = 0; k < balls.size(); ++k) {
            const Vec3 margin{balls[k].w, balls[k].w, balls[k].w};
            if (!contains({world.lower + margin, world.upper - margin}, xyz(balls[k])))
                report.fail("ball " + text(k) + " of " + text(count), text(balls[k]),
                            "inside " + text(world.lower) + " to " + text(world.upper));
        }
    }
}

void noneTouch(Report& report) {
    for (const int count : counts) {
        const Placed placed = placeAll(report.device, count);
        for (std::size_t i = 0; i < placed.balls.size(); ++i)
            for (std::size_t j = i + 1; j < placed.balls.size(); ++j) {
                const Vec4 a = placed.balls[i], b = placed.balls[j];
                const float distance = length(xyz(a) - xyz(b));
                if (!(distance > a.w + b.w))
                    report.fail("balls " + text(i) + " and " + text(j) + " of " + text(count) +
                                    ", distance in m",
                                text(distance), "more than " + text(a.w + b.w));
            }
        guessMistake(report, placed.balls, 0);
    }
    if (report.failed())
        report.picture([&] { return drawHill(placeAll(report.device, 33), oracle(33, 0)); });
}

void usableColors(Report& report) {
    for (const int count : counts) {
        const std::vector<Vec3> colors = placeAll(report.device, count, report.seed).colors;
        for (std::size_t k = 0; k < colors.size(); ++k)
            if (!contains({{0, 0, 0}, {1, 1, 1}}, colors[k]))
                report.fail("colour of ball " + text(k) + " of " + text(count), text(colors[k]),
                            "three numbers between 0 and 1");
    }
}

void nearOracle(Report& report) {
    for (const int count : counts)
        requireNearOracle(report, count, report.seed + static_cast<std::uint64_t>(count));
    // Short enough for one thread: what depends on the order of threads is for hello.order to find.
    requireNearOracle(report, serialCount - 1, report.seed);
    const std::vector<Vec4> balls = placeAll(report.device, 1000).balls;
    std::map<std::size_t, int> steps;  // by how much nearest balls' numbers differ: how often
    for (std::size_t i = 0; i < balls.size(); ++i) {
        std::size_t nearest = i == 0 ? 1 : 0;
        for (std::size_t j = 0; j < balls.size(); ++j)
            if (j != i && lengthSquared(xyz(balls[j]) - xyz(balls[i])) <
                              lengthSquared(xyz(balls[nearest]) - xyz(balls[i])))
                nearest = j;
        ++steps[nearest > i ? nearest - i : i - nearest];
    }
    std::string list;
    for (const auto& [step, times] : steps)
        list += (list.empty() ? "" : ", ") + text(step) + " (" + text(times) + "x)";
    report.measured("the numbers of a ball and its nearest neighbour differ by " + list);
}

void anyOrder(Report& report) {
    inEveryOrder(report, [&] { return placeAll(report.device, 6000, report.seed); });
}

void goldenHash(Report& report) {
    struct Row {
        int count;
        const char *state, *all;
    };
    for (const Row& row : {Row{0, "cbf29ce484222325", "cbf29ce484222325"},
                           {1, "67a2e575efdbd721", "37586429a8da6bc7"},
                           {33, "ca24b80cf5bc1c8d", "1ce681db90cd5289"},
                           {1000, "fca481b0d7fcab69", "7ead7ac814dcbae0"}}) {
        const Placed placed = placeAll(report.device, row.count);
        const std::string state = hashText(stateHash(spheresOf(placed)));
        if (state != row.state)
            report.fail("state hash of " + text(row.count) + " balls", state, row.state);
        const std::string all = hashText(wordHash(placed.words()));
        if (all != row.all)
            report.fail("hash of places, radii and colours of " + text(row.count) + " balls", all,
                        row.all);
        report.guess(
            {{"right to a tenth of a millimetre, but other bits: another sine, a sum in "
              "another order, or a compiler that may change the arithmetic",
              [&] { return allNear(placed.balls, oracle(row.count, 0)); }}});
    }
}

/// The bytes of a small picture of balls, as `--png` makes it.
std::string pictureOf(const Spheres& spheres) {
    const std::string name = "ballpit_check_00_" + std::to_string(getpid()) + ".png";
    Options options;
    options.png = (std::filesystem::temp_directory_path() / name).string();
    options.width = 320;
    options.height = 180;
    showSpheres(options, world, spheres);
    std::string bytes;
    {
        std::ifstream file(options.png, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(file), {});
    }
    std::filesystem::remove(options.png);
    return bytes;
}

void pictureShowsBalls(Report& report) {
    try {
        const std::string balls = pictureOf(spheresOf(placeAll(report.device, 100)));
        if (balls.empty() || balls == pictureOf(Spheres{}))
            report.fail("the picture of 100 balls looks like that of an empty box");
    } catch (const InputError& error) {
        report.measured(std::string("no picture on this machine: ") + error.what());
    }
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "00",
        {{"hello.sine", "The sine of an angle in steps is right to five digits",
          "A whole turn is 2^32 steps. Both functions work on the fraction of a turn, with + - * "
          "alone.",
          sineByHand},
         {"hello.eight",
          "Eight balls have the place and radius worked out by hand: ball k lies sqrt(2k + 1) m "
          "from the middle",
          "What is wrong for eight balls is wrong for a million, and eight fit on a sheet of "
          "paper.",
          eightByHand},
         {"hello.each", "A launch for n balls writes elements 0 to n - 1, and no other",
          "Index i writes element i: that is the whole contract between a kernel and its launch. "
          "The counts are no multiples of 256, the size of a block of threads.",
          eachOnce},
         {"hello.again", "Memory that was used before gives the same bits as fresh memory",
          "The engine keeps its arrays from step to step. What a kernel does not write is old.",
          usedBuffers},
         {"hello.box", "Every ball lies inside the world, above the floor",
          "The grid of the later chapters covers the world, and nothing else.", insideBox},
         {"hello.apart", "No two balls touch",
          "The golden turn keeps balls apart, however many there are.", noneTouch},
         {"hello.colors", "Every colour is three numbers between 0 and 1",
          "The renderer takes red, green and blue from 0 (none) to 1 (full).", usableColors},
         {"hello.oracle", "Every ball lies where the library's sine, in double precision, puts it",
          "An answer found by another way is the best test there is: the two share no mistake.",
          nearOracle},
         {"hello.order", "The result does not depend on the order of the threads",
          "A GPU gives no order. A kernel that reads what another index writes depends on it.",
          anyOrder},
         {"hello.hash", "The state hash is the lesson's, to the last digit",
          "The same bits on every machine: this is what lets you compare your run with ours.",
          goldenHash},
         {"hello.picture", "A picture shows the balls",
          "It is drawn by OpenGL without a display. Where that is not installed, a line says so "
          "and "
          "all else still works.",
          pictureShowsBalls}});
}
