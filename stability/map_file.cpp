// Writing a map's CSV.
#include "stability/map_file.h"

#include <sstream>

#include "common/whole_file.h"
#include "common/words.h"

namespace ballpit::stability {

namespace {

/// Panels' names have commas.
std::string quoted(const std::string& text) { return '"' + text + '"'; }

void writePanel(std::ostream& file, const Panel& panel, const std::vector<Outcome>& outcomes) {
    const std::string panelName = quoted(panel.name);
    file << "axes," << panelName << ',' << quoted(panel.x.label) << ',' << quoted(panel.y.label)
         << ",,,\n";
    std::size_t k = 0;
    for (const double y : panel.y.values)
        for (const double x : panel.x.values) {
            const Outcome outcome = outcomes[k++];
            file << "cell," << panelName << ',' << withDigits(x) << ',' << withDigits(y) << ','
                 << name(outcome.verdict) << ',' << withDigits(outcome.value, 4) << ",\n";
        }
    for (const Line& line : panel.lines)
        for (const auto& [x, y] : line.points)
            file << "line," << panelName << ',' << withDigits(x, 4) << ',' << withDigits(y, 4)
                 << ",,," << quoted(line.label) << '\n';
}

}  // namespace

void writeMap(const std::string& path, const Map& map,
              const std::vector<std::vector<Outcome>>& outcomes, const std::string& stamp) {
    std::ostringstream file;
    file << "# map: " << map.name << "\n# title: " << map.title << "\n# ok: " << map.ok
         << "\n# value: " << map.value << '\n'
         << asComments(stamp) << "kind,panel,x,y,verdict,value,label\n";
    for (std::size_t p = 0; p < map.panels.size(); ++p)
        writePanel(file, map.panels[p], outcomes[p]);
    writeWhole(path, file.str());
}

}  // namespace ballpit::stability
