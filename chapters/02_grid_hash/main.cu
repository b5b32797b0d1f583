// Chapter 02's executable: which cell is each ball in? Cells that touch get different colours.
#include "02_grid_hash/grid_hash.cuh"

#include "common/film.h"
#include "common/findings.h"
#include "common/launch.cuh"
#include "common/metrics.h"
#include "common/random.h"
#include "common/timing.h"

using namespace ballpit;
constexpr Bounds world{{-4, -3, -2}, {4, 3, 2}};
constexpr float cellSize = 2, r = 0.15f;

/// The eight balls of the lesson, then random ones.
static std::vector<Vec4> makeBalls(int count, std::uint64_t seed) {
    std::vector<Vec4> balls{{-3, -2, -1, r}, {-0.5f, -2, -1, r}, {0.5f, -2, -1, r}, {3, 2, -1, r},
                            {1, 0, 1, r},    {1.5f, 0.5f, 1, r}, {3, 2, 1, r},      {-5, 0, 1, r}};
    balls.resize(static_cast<std::size_t>(count));
    Random random(seed);
    for (std::size_t k = 8; k < balls.size(); ++k) balls[k] = withW(random.uniformIn(world), r);
    return balls;
}

static int run(const Options& options) {
    const std::vector<Vec4> balls = makeBalls(options.count, options.seed);
    UniformGrid grid(options.device, world, cellSize, options.count);
    DeviceBuffer<Vec4> positions(options.device, balls.size(), "positions");
    DeviceBuffer<StepStatus> status(options.device, 1, "status");
    positions.upload(balls);
    status.fill(0);
    const auto hashAll = [&] {
        launch<computeGridHash>(options.device, options.count, grid.view(),
                                View<const Vec4>(positions.view()), grid.hashes.view(),
                                grid.indices.view(), status.view());
    };
    hashAll();
    const std::vector<std::uint32_t> hashes = grid.hashes.download();
    Spheres spheres;
    for (std::size_t k = 0; k < balls.size(); ++k) {
        const Int3 cell = cellFromHash(grid.resolution, hashes[k]);
        const int shade = 3 * (cell.x & 1) + 6 * (cell.y & 1) + 4 * (cell.z & 1);
        spheres.add(xyz(balls[k]), {}, r, 1, 1, paletteColor(static_cast<std::size_t>(shade)));
    }
    Findings findings("02 grid_hash");
    findings.add("count", std::int64_t{options.count});
    findings.add("cells", std::int64_t(grid.cellCount()));
    findings.add("balls outside the world", std::int64_t{status.download()[0].outside});
    findings.add("state hash", hashText(wordHash(hashes)));
    findings.list("positions", spheres.positions);
    findings.list("hashes", hashes);
    if (options.time) findings.add("milliseconds", medianMilliseconds(options.device, 31, hashAll));
    findings.print(options.json);
    showSpheres(options, world, spheres);
    return exitOk;
}

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Which cell of the grid is each ball in?", {.count = 4000}, run);
}
