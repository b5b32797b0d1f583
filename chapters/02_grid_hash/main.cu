// Chapter 02's executable: which cell is each ball in? Cells that touch get different colours.
#include "chapters/02_grid_hash/cells.cuh"
#include "common/film.h"
#include "common/findings.h"
#include "common/metrics.h"
#include "common/motion.h"
#include "common/timing.h"

using namespace ballpit;

/// In the film the balls drift from cell to cell.
static void show(const Options& options, Spheres balls, HashedBalls& hashed) {
    stir(balls, {1, 1, 1}, options.seed + 1);
    showMotion(options, world, balls, [&](Spheres& moving, float share) {
        if (share > 0) drift(moving, world);
        hashed.place(moving);
        hashed.color(moving);
    });
}

static int run(const Options& options) {
    const Spheres balls = makeBalls(options.count, options.seed);
    HashedBalls hashed(options.device, options.count);
    hashed.place(balls);

    Findings findings("02 grid_hash");
    findings.add("count", std::int64_t{options.count});
    findings.add("cells", hashed.cellCount());
    findings.add("balls outside the world", hashed.outside());
    findings.add("state hash", hashText(wordHash(hashed.hashes())));
    findings.list("positions", balls.positions);
    findings.list("hashes", hashed.hashes());
    if (options.time)
        findings.add("milliseconds",
                     medianMilliseconds(options.device, 31, [&] { hashed.hashAll(); }));
    findings.print(options.json);
    show(options, balls, hashed);
    return exitOk;
}

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Which cell of the grid is each ball in?", {.count = 4000}, run);
}
