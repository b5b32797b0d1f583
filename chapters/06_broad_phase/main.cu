// Chapter 06's executable: how much the search in the grid looks at, and what one ball sees of it.
#include "chapters/06_broad_phase/seeker.cuh"
#include "common/findings.h"
#include "common/metrics.h"
#include "common/timing.h"

using namespace ballpit;

namespace {

constexpr int mostForNaive = 65536;  // nobody waits for the square of more

void addTimes(Findings& findings, const Options& options, const World& world, Search& search) {
    const auto time = [&](auto work) { return medianMilliseconds(options.device, 11, work); };
    const double build = time([&] { search.grid.build(); });
    findings.add("milliseconds", time([&] { search.find(); }));
    findings.add("milliseconds to build the grid", build);
    if (options.count > mostForNaive) return;
    NaiveSearch naive(options.device, world.spheres);
    findings.add("milliseconds, naive", time([&] { naive.find(); }));
}

int run(const Options& options) {
    const World world = scatteredBalls(options.count, options.seed);
    Search search(options.device, world);
    search.find();
    const std::vector<Pair> pairs = search.pairs();
    const int seeker = search.slotInTheMiddle(world);

    Findings findings("06 broad_phase");
    findings.add("count", std::int64_t{options.count});
    findings.add("comparisons, naive", std::int64_t{options.count} * (options.count - 1) / 2);
    findings.add("candidates, grid", search.candidates());
    findings.add("touching pairs", static_cast<std::int64_t>(pairs.size()));
    findings.list("positions", search.inSlots(world.spheres.positions));
    findings.list("hashes", search.grid.hashes());
    findings.list("pairs", words(pairs));
    findings.add("seeker", std::int64_t{seeker});
    findings.add("state hash", hashText(wordHash(words(pairs))));
    findings.list("runs", words(search.rangesOf(seeker).rows));
    if (options.time) addTimes(findings, options, world, search);
    findings.print(options.json);
    const World seen = search.seenBy(seeker, world);
    options.isFilmed() ? showSeeker(options, world)
                       : showSpheres(options, seen.bounds, seen.spheres);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Who touches whom? Ask the neighbours.", {.count = 1000}, run);
}
