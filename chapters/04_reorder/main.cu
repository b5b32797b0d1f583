// Chapter 04's executable: what cell order in memory is worth to a search.
#include "chapters/04_reorder/reading.cuh"
#include "chapters/04_reorder/two_orders.cuh"
#include "common/findings.h"
#include "common/metrics.h"
#include "common/timing.h"

using namespace ballpit;
using enum MemoryOrder;

namespace {

void addTimes(Findings& findings, const Options& options, TwoOrders& orders) {
    const auto time = [&](auto work) { return medianMilliseconds(options.device, 31, work); };
    const double bytes = options.count * static_cast<double>(bytesMovedPerBody());
    const double gather = time([&] { orders.gather(); });
    const double again = time([&] { orders.gatherAgain(); });
    const double random = time([&] { orders.search(asTheyCame); });
    const double sorted = time([&] { orders.search(byCell); });
    findings.add("milliseconds", gather);
    findings.add("GB/s", 1e-6 * bytes / gather);
    findings.add("milliseconds, sorted before", again);
    findings.add("GB/s, sorted before", 1e-6 * bytes / again);
    findings.add("search ms, as they came", random);
    findings.add("search ms, by cell", sorted);
}

int run(const Options& options) {
    const Scene scene = makeScene("uniform", options.count, options.seed);
    TwoOrders orders(options.device, scene);
    const bool same = orders.touching(asTheyCame) == orders.touching(byCell);
    const Spheres balls = orders.download(byCell);
    const std::vector<std::uint32_t> before = orders.ids(asTheyCame), after = orders.ids(byCell);
    Findings findings("04 reorder");
    findings.add("count", std::int64_t{options.count});
    findings.add("step in memory before m", meanStep(balls.positions, before));
    findings.add("step in memory after m", meanStep(balls.positions, after));
    findings.add("bytes moved for a ball", static_cast<std::int64_t>(bytesMovedPerBody()));
    findings.add("same touching balls", same ? "yes" : "NO");
    findings.add("order hash", hashText(wordHash(after)));
    findings.add("state hash", hashText(stateHash(balls)));
    findings.list("positions", balls.positions);
    findings.list("ids", after);
    findings.list("cells", orders.cells());
    if (options.time) addTimes(findings, options, orders);
    findings.print(options.json);
    showReading(options, scene.bounds, balls, before, after);
    return exitOk;
}

}  // namespace

int main(int argc, char** argv) {
    return runChapter(argc, argv, "What is cell order in memory worth?", {.count = 1000}, run);
}
