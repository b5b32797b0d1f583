// What is measured at the end of a run, and how the table is written.
#include "stability/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "common/words.h"
#include "truth/kinetic_theory.h"

namespace ballpit::stability {

namespace {

struct Column {
    const char* name;
    double Measures::*value;
};

constexpr Column columns[] = {{"error", &Measures::error},
                              {"within", &Measures::within},
                              {"penetration rms / r", &Measures::penetrationRms},
                              {"penetration max / r", &Measures::penetrationMax},
                              {"energy drift mean", &Measures::driftMean},
                              {"energy drift largest", &Measures::driftLargest},
                              {"momentum error", &Measures::momentum},
                              {"lost", &Measures::lost},
                              {"not finite", &Measures::notFinite},
                              {"Maxwell distance", &Measures::maxwell},
                              {"T / Haff", &Measures::haff},
                              {"free time / Enskog", &Measures::meanFreeTime},
                              {"Z / Carnahan-Starling", &Measures::pressure},
                              {"packing", &Measures::packing},
                              {"coordination", &Measures::coordination},
                              {"velocity noise / (g dt)", &Measures::noise},
                              {"floor load / weight", &Measures::load},
                              {"pair visits / simulated s", &Measures::pairVisits},
                              {"repeat distance (m)", &Measures::repeatDistance},
                              {"same bits", &Measures::sameBits},
                              {"TIME: ms / simulated s", &Measures::milliseconds}};

/// Statistics of fewer balls say nothing.
constexpr std::size_t fewestForStatistics = 100;

std::string text(double value) { return std::isfinite(value) ? withDigits(value, 4) : ""; }

/// The cells of a row, those of the head if there is none.
std::vector<std::string> cellsOf(const TableRow* row) {
    std::vector<std::string> cells{"scene", "method", "status", "balls", "simulated s"};
    if (row)
        cells = {row->scene, row->method, row->status, std::to_string(row->balls),
                 text(row->seconds)};
    for (const Column& column : columns)
        cells.push_back(row ? text(row->measures.*column.value) : column.name);
    return cells;
}

std::string joined(const std::vector<std::string>& cells, const std::string& between) {
    std::string line;
    for (const std::string& cell : cells) line += (&cell == &cells[0] ? "" : between) + cell;
    return line;
}

/// Like joined, with what has a comma or a quote in quotes.
std::string csvLine(std::vector<std::string> cells) {
    for (std::string& cell : cells) {
        if (cell.find_first_of(",\"") == std::string::npos) continue;
        std::string quoted = "\"";
        for (const char c : cell) quoted += c == '"' ? "\"\"" : std::string(1, c);
        cell = quoted + '"';
    }
    return joined(cells, ",") + '\n';
}

double volumeOf(Bounds box) {
    const Vec3 size = extent(box);
    return double(size.x) * size.y * size.z;
}

bool hasFloor(const Scene& scene) { return scene.gravity.y < 0; }

/// Equal balls in numbers, without gravity, in motion.
bool isGas(const Scene& scene) {
    const Spheres& s = scene.spheres;
    const auto [smallest, largest] = std::minmax_element(s.radii.begin(), s.radii.end());
    return scene.gravity == Vec3{} && s.count() >= fewestForStatistics && *smallest == *largest &&
           temperatureOf(s) > 0;
}

void measureGas(const RunRecord& run, Measures& m) {
    const Spheres& start = run.scene.spheres;
    const double sigma = 2 * double(start.radii[0]), mass = start.masses[0];
    const double T0 = temperatureOf(start), T = temperatureOf(run.end);
    const double rho = static_cast<double>(start.count()) / volumeOf(run.scene.bounds);
    const double rate = truth::enskogRate(rho, sigma, T0, mass);
    const double e = start.restitutions[0];
    if (e < 1) {
        m.haff = haffRatio(T, T0, run.seconds, truth::haffTime(e, rate));
        return;
    }
    m.maxwell = maxwellDistance(run.end);
    if (!(run.collisions > 0)) return;
    const double free = meanFreeTime(start.count(), run.seconds, run.collisions);
    m.meanFreeTime = free * rate;
    m.pressure = compressibilityFrom(free, sigma, mass, T) /
                 truth::carnahanStarling(truth::volumeShare(rho, sigma));
}

/// A heap is measured in the middle half of its height: half its balls lie below their mean height.
void measureHeap(const RunRecord& run, Measures& m) {
    double mean = 0;
    for (const Vec3 p : run.end.positions) mean += double(p.y) - run.scene.bounds.lower.y;
    mean /= static_cast<double>(run.end.count());
    constexpr double slack = 0.01;
    const double floor = run.scene.bounds.lower.y;
    m.packing = packingFraction(run.end, run.scene.bounds, floor + 0.5 * mean, floor + 1.5 * mean);
    m.coordination = coordination(run.end, slack);
}

}  // namespace

void measureEnd(const RunRecord& run, Measures& m) {
    const Scene& scene = run.scene;
    const Overlap overlap = overlapOf(run.end, scene.bounds, scene.periodic);
    m.penetrationRms = overlap.rms;
    m.penetrationMax = overlap.max;
    const Losses losses = lossesOf(run.end, scene.bounds);
    m.lost = static_cast<double>(losses.lost);
    m.notFinite = static_cast<double>(losses.notFinite);
    if (losses.notFinite > 0) return;
    if (scene.gravity == Vec3{} && !run.metWalls)
        m.momentum = momentumError(scene.spheres, run.end);
    if (isGas(scene)) measureGas(run, m);
    if (!hasFloor(scene)) return;
    const double g = -double(scene.gravity.y);
    m.noise = velocityNoise(run.end, g, scene.dt);
    m.load = floorLoad(run.secondBefore, run.end, g, run.lastSecond);
    if (scene.spheres.count() >= fewestForStatistics) measureHeap(run, m);
}

bool mayHaveMetWall(const Spheres& s, Bounds walls, double dt) {
    for (std::size_t k = 0; k < s.count(); ++k)
        for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            const double place = s.positions[k].*axis, way = std::abs(s.velocities[k].*axis) * dt;
            if (std::min(place - walls.lower.*axis, walls.upper.*axis - place) <= s.radii[k] + way)
                return true;
        }
    return false;
}

std::string csvOf(const std::vector<TableRow>& rows, const std::string& stamp) {
    std::string csv = asComments(stamp) + csvLine(cellsOf(nullptr));
    for (const TableRow& row : rows) csv += csvLine(cellsOf(&row));
    return csv;
}

std::string markdownOf(const std::vector<TableRow>& rows, const std::string& stamp) {
    std::istringstream lines(stamp);
    std::string markdown;
    for (std::string line; std::getline(lines, line);) markdown += line + "\n\n";
    const std::vector<std::string> head = cellsOf(nullptr);
    markdown += "| " + joined(head, " | ") + " |\n|---|---|---";
    for (std::size_t k = 3; k < head.size(); ++k) markdown += "|--:";
    markdown += "|\n";
    for (const TableRow& row : rows) markdown += "| " + joined(cellsOf(&row), " | ") + " |\n";
    return markdown;
}

}  // namespace ballpit::stability
