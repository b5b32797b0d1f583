// Chapter 01's executable: balls scattered on a table; those that touch another are red.
#include "chapters/01_naive_collision/table.cuh"
#include "common/film.h"
#include "common/findings.h"
#include "common/metrics.h"
#include "common/motion.h"
#include "common/timing.h"

using namespace ballpit;

namespace {

/// In the film the balls drift over the table and through each other.
void show(const Options& options, Spheres spheres, TouchSearch& search) {
    stir(spheres, {1.5f, 0, 1.5f}, options.seed + 1);
    Bounds shown = tableFor(options.count);
    shown.lower.y = -0.8f;
    shown.upper.y = 0.4f * shown.upper.x;
    showMotion(options, shown, spheres, [&](Spheres& balls, float share) {
        if (share > 0) drift(balls, tableFor(options.count));
        search.place(balls);
        colorTouching(balls, search.pairs());
    });
}

int run(const Options& options) {
    const int count = options.count;
    const Spheres spheres = scatterBalls(count, options.seed);
    TouchSearch search(options.device, spheres);
    const std::vector<Pair> list = search.pairs();
    std::vector<std::uint32_t> touching;
    for (const auto [a, b] : list) touching.insert(touching.end(), {a, b});

    Findings findings("01 naive_collision");
    findings.add("count", std::int64_t{count});
    findings.add("comparisons", std::int64_t{count} * (count - 1) / 2);
    findings.add("touching pairs", static_cast<std::int64_t>(list.size()));
    findings.add("state hash", hashText(wordHash(touching)));
    findings.list("positions", spheres.positions);
    findings.list("radii", std::vector<double>(spheres.radii.begin(), spheres.radii.end()));
    findings.list("pairs", touching);
    if (options.time)
        findings.add("milliseconds",
                     medianMilliseconds(options.device, 7, [&] { search.search(); }));
    findings.print(options.json);
    show(options, spheres, search);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Which balls touch?", {.count = 1000}, run);
}
