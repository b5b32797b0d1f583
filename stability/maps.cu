// ballpit_maps: where each response holds and where it fails, as CSV. `./ballpit maps` draws them.
#include <iostream>

#include "common/cli.h"
#include "common/whole_file.h"
#include "common/words.h"
#include "stability/catalogue.h"
#include "stability/map_file.h"
#include "stability/run_maps.cuh"

using namespace ballpit;
using namespace ballpit::stability;

namespace {

struct Asked {
    std::vector<std::string> names;
    MapOptions options;
    std::string out = ".", stamp;
    bool scenes = false;
};

std::string allNames() {
    return commaSeparated(mapKinds(), [](const MapKind& kind) { return kind.name; });
}

/// The kinds that were asked for: all, if none.
std::vector<MapKind> kindsOf(const std::vector<std::string>& names) {
    if (names.empty()) return mapKinds();
    std::vector<MapKind> kinds;
    for (const std::string& wanted : names) {
        const auto found = std::find_if(mapKinds().begin(), mapKinds().end(),
                                        [&](const MapKind& kind) { return kind.name == wanted; });
        if (found == mapKinds().end())
            throw InputError("map '" + wanted + "': known maps are " + allNames());
        kinds.push_back(*found);
    }
    return kinds;
}

/// The catalogue as a Markdown table, for docs/stability.md.
int printScenes() {
    std::printf(
        "| scene | balls | question | held against | within | knobs |\n"
        "|---|---|---|---|---|---|\n");
    for (const Entry& e : catalogue()) {
        std::string balls = std::to_string(e.usualCount);
        if (e.leastCount != e.mostCount)
            balls +=
                " (" + std::to_string(e.leastCount) + " to " + std::to_string(e.mostCount) + ")";
        std::printf("| `%s` | %s | %s | %s | %s | %s |\n", e.name, balls.c_str(), e.question,
                    e.truth, toleranceText(e).c_str(), e.knobs);
    }
    return exitOk;
}

int run(const Asked& asked) {
    if (asked.scenes) return printScenes();
    const std::vector<MapKind> kinds = kindsOf(asked.names);
    requireUsable(asked.options.device);
    requireOutFolder(asked.out);
    const StopRequest stop;
    const int threads = cpuThreadCount();
    for (const MapKind& kind : kinds) {
        const Map map = kind.make(asked.options);
        const double seconds = asked.options.coarse ? kind.coarseSeconds : kind.seconds;
        std::fprintf(stderr, "%s: %zu cells, about %.0f s on %d idle cores\n", kind.name,
                     cellCount(map), std::ceil(seconds / threads), threads);
        const std::optional<Outcomes> outcomes = runMap(map, asked.options.device);
        constexpr int stoppedByUser = 130;
        if (!outcomes) return stoppedByUser;
        const std::string path = asked.out + "/map_" + kind.name + ".csv";
        writeMap(path, map, *outcomes, asked.stamp);
        std::cout << path << std::endl;
    }
    return exitOk;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Where each response holds and where it fails: CSV files, map_NAME.csv."};
    Asked asked;
    app.add_option("names", asked.names, "maps to make (default: all): " + allNames());
    app.add_flag("--coarse", asked.options.coarse, "few cells, small scenes");
    addDevice(app, asked.options.device);
    addOutput(app, asked.out, asked.stamp);
    app.add_flag("--scenes", asked.scenes, "print the table of scenes instead, as Markdown");
    if (const auto end = endAfterParsing(app, argc, argv)) return *end;
    return reportingErrors([&] { return run(asked); });
}
