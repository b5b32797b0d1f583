// Chapter 02's executable: which cell is each ball in? Balls of one cell get one colour.
#include "02_grid_hash/grid_hash.cuh"

#include <algorithm>
#include <map>

#include "common/film.h"
#include "common/findings.h"
#include "common/launch.cuh"
#include "common/metrics.h"
#include "common/random.h"
#include "common/timing.h"

using namespace ballpit;

namespace {

constexpr Bounds world{{-6, -6, -6}, {6, 6, 6}};
constexpr float cellSize = 1.5f, radius = 0.3f;

Spheres makeBalls(int count, std::uint64_t seed) {
    Random random(seed);
    Spheres spheres;
    for (int k = 0; k < count; ++k) spheres.add(random.uniformIn(world), {}, radius, 1.0f, 1.0f);
    return spheres;
}

int run(const Options& options) {
    Spheres spheres = makeBalls(options.count, options.seed);
    std::vector<Vec4> balls;
    for (const Vec3 p : spheres.positions) balls.push_back(withW(p, radius));
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
    std::map<std::uint32_t, int> population;
    for (const std::uint32_t hash : hashes) ++population[hash];
    int fullest = 0;
    for (const auto& [cell, balls] : population) fullest = std::max(fullest, balls);
    // Multiplied, so that cells that are neighbours get different colours.
    for (std::size_t k = 0; k < hashes.size(); ++k)
        spheres.colors[k] = paletteColor(hashes[k] * 2654435761u >> 16);

    Findings findings("02 grid_hash: " + std::to_string(options.count) + " balls");
    findings.add("cells", static_cast<std::int64_t>(grid.cellCount()));
    findings.add("occupied cells", static_cast<std::int64_t>(population.size()));
    findings.add("balls in the fullest cell", std::int64_t{fullest});
    findings.add("balls outside the world", std::int64_t{status.download()[0].outside});
    findings.add("state hash", hashText(wordHash(hashes)));
    if (options.time) findings.add("milliseconds", medianMilliseconds(options.device, 31, hashAll));
    findings.print(options.json);
    showSpheres(options, world, spheres);
    return exitOk;
}

}  // namespace

int main(int argc, char** argv) {
    Options defaults;
    defaults.count = 1000;
    return runChapter(argc, argv, "Which cell of the grid is each ball in?", defaults, run);
}
