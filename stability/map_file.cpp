// Writing a map's CSV.
#include "stability/map_file.h"

#include <cstdio>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "common/csv.h"

namespace ballpit::stability {

namespace {

void writeComments(std::FILE* file, const Map& map, const std::string& stamp) {
    std::fprintf(file, "# map: %s\n# title: %s\n# ok: %s\n# value: %s\n", map.name.c_str(),
                 map.title.c_str(), map.ok.c_str(), map.value.c_str());
    std::istringstream lines(stamp);
    for (std::string line; std::getline(lines, line);) std::fprintf(file, "# %s\n", line.c_str());
}

/// Panels' names have commas.
std::string quoted(const std::string& text) { return '"' + text + '"'; }

void writePanel(std::FILE* file, const Panel& panel, const std::vector<Outcome>& outcomes) {
    const std::string panelName = quoted(panel.name);
    std::fprintf(file, "axes,%s,%s,%s,,,\n", panelName.c_str(), quoted(panel.x.label).c_str(),
                 quoted(panel.y.label).c_str());
    std::size_t k = 0;
    for (const double y : panel.y.values)
        for (const double x : panel.x.values) {
            const Outcome outcome = outcomes[k++];
            std::fprintf(file, "cell,%s,%g,%g,%s,%.4g,\n", panelName.c_str(), x, y,
                         name(outcome.verdict), outcome.value);
        }
    for (const Line& line : panel.lines)
        for (const auto& [x, y] : line.points)
            std::fprintf(file, "line,%s,%.4g,%.4g,,,%s\n", panelName.c_str(), x, y,
                         quoted(line.label).c_str());
}

}  // namespace

void writeMap(const std::string& path, const Map& map,
              const std::vector<std::vector<Outcome>>& outcomes, const std::string& stamp) {
    requireWritable(path);
    const std::string part = path + ".part";
    std::FILE* file = std::fopen(part.c_str(), "w");
    if (!file) throw std::runtime_error(path + ": cannot be written");
    writeComments(file, map, stamp);
    std::fprintf(file, "kind,panel,x,y,verdict,value,label\n");
    for (std::size_t p = 0; p < map.panels.size(); ++p)
        writePanel(file, map.panels[p], outcomes[p]);
    const bool complete = std::ferror(file) == 0;
    if (std::fclose(file) != 0 || !complete) {
        std::filesystem::remove(part);
        throw std::runtime_error(path + ": writing failed (disk full?); nothing was left behind");
    }
    std::filesystem::rename(part, path);
}

}  // namespace ballpit::stability
