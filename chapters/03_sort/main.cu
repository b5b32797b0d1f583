// Chapter 03's executable: sorts the hashes of random balls pass by pass, and races the library.
#include "03_sort/sort.cuh"

#include "02_grid_hash/grid_hash.cuh"
#include "chapters/03_sort/passes.cuh"
#include "common/findings.h"
#include "common/metrics.h"
#include "common/random.h"
#include "common/timing.h"

using namespace ballpit;

static int run(const Options& o) {
    // About one cell of 1 m for each ball, but at least 8 x 8 x 8.
    const float half = std::max(8.0f, std::ceil(std::cbrt(static_cast<float>(o.count)))) / 2;
    const Bounds world{{-half, -half, -half}, {half, half, half}};
    UniformGrid grid(o.device, world, 1, o.count);
    Random random(o.seed);
    Spheres spheres;
    std::vector<std::uint32_t> hashes, slots;
    for (std::uint32_t k = 0; k < grid.hashes.count(); ++k) {
        spheres.add(random.uniformIn(world), {}, 0.3f, 1, 1);
        const Int3 cell = cellOf(grid.view(), spheres.positions[k]);
        hashes.push_back(cellHash(grid.resolution, clampToGrid(grid.view(), cell)));
        slots.push_back(k);
    }
    const int bits = grid.hashBits(), passes = (bits + digitBits - 1) / digitBits;
    RadixSortSpace space(o.device, o.count);
    Scratch scratch(o.device, 0, "scratch");
    const auto unsort = [&] { grid.hashes.upload(hashes), grid.indices.upload(slots); };
    const auto sort = [&] { radixSort(o.device, bits, grid.hashes, grid.indices, space); };

    Findings findings("03 sort");
    findings.add("count", std::int64_t{o.count});
    findings.add("key bits", std::int64_t{bits});
    findings.add("passes", std::int64_t{passes});
    const auto orderAfter = [&](int pass) {
        unsort(), radixSort(o.device, pass * digitBits, grid.hashes, grid.indices, space);
        return grid.indices.download();
    };
    for (int pass = 0; pass <= passes && o.count <= 1000; ++pass)
        findings.list("slots " + std::to_string(pass), orderAfter(pass)),
            findings.list("keys " + std::to_string(pass), grid.hashes.download());
    unsort(), sort();
    const std::vector<std::uint32_t> sorted = grid.indices.download();
    findings.add("state hash", hashText(wordHash(sorted)));
    const auto timeOf = [&](auto work) { return medianMilliseconds(o.device, 31, unsort, work); };
    if (o.time) findings.add("milliseconds", timeOf(sort));
    if (o.time)
        findings.add("library milliseconds",
                     timeOf([&] { sortByHash(o.device, o.count, grid, scratch); }));
    findings.print(o.json);
    colorEighths(spheres, sorted);
    o.isFilmed() ? showPasses(o, hashes, passes, orderAfter) : showSpheres(o, world, spheres);
    return exitOk;
}

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Hashes, sorted digit by digit.", {.count = 1000}, run);
}
