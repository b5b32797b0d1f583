// Chapter 05's executable: which cells hold balls, and who is around a ball?
#include "chapters/05_cell_bounds/crowd.cuh"
#include "common/findings.h"
#include "common/metrics.h"
#include "common/timing.h"

using namespace ballpit;

namespace {

void addTimes(Findings& findings, const Options& options, Population& population) {
    const auto time = [&](auto work) { return medianMilliseconds(options.device, 31, work); };
    findings.add("milliseconds", time([&] { population.build(); }));
    findings.add("search ms, cell by cell", time([&] { population.search<false>(); }));
    findings.add("search ms, row by row", time([&] { population.search<true>(); }));
}

int run(const Options& options) {
    const Scene scene = makeScene("uniform", options.count, options.seed);
    Population population(options.device, scene);
    const auto starts = population.starts(), ends = population.ends();
    const auto around = population.around<true>();
    std::vector<std::uint32_t> bounds(starts);
    bounds.insert(bounds.end(), ends.begin(), ends.end());
    std::int64_t occupied = 0, fullest = 0, sum = 0;
    for (std::size_t cell = 0; cell < starts.size(); ++cell) {
        const std::int64_t inside = std::int64_t{ends[cell]} - std::int64_t{starts[cell]};
        occupied += inside > 0;
        fullest = std::max(fullest, inside);
    }
    for (const std::uint32_t balls : around) sum += balls;
    Findings findings("05 cell_bounds");
    findings.add("count", std::int64_t{options.count});
    findings.add("cells", static_cast<std::int64_t>(starts.size()));
    findings.add("occupied cells", occupied);
    findings.add("balls in the fullest cell", fullest);
    findings.add("balls around a ball", static_cast<double>(sum) / options.count);
    findings.add("same by cells and by rows", around == population.around<false>() ? "yes" : "NO");
    findings.add("state hash", hashText(wordHash(bounds)));
    findings.list("hashes", population.hashes());
    findings.list("starts", starts);
    findings.list("ends", ends);
    if (options.time) addTimes(findings, options, population);
    findings.print(options.json);
    showCrowd(options, scene);
    return exitOk;
}

}  // namespace

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Which cells hold balls, and who is around?", {.count = 1000},
                      run);
}
