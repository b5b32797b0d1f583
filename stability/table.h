// The table of metrics: each scene under each method, one row a run, one column a metric.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "common/scene.h"
#include "stability/metrics.h"

namespace ballpit::stability {

/// What a run comes to. NaN where the scene has no such thing: the table leaves that place empty.
struct Measures {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double error = none, within = none;
    double penetrationRms = none, penetrationMax = none;
    double driftMean = none, driftLargest = none, momentum = none;
    double lost = none, notFinite = none;
    double maxwell = none, haff = none, meanFreeTime = none, pressure = none;
    double packing = none, coordination = none, noise = none, load = none;
    double pairVisits = none, repeatDistance = none, sameBits = none, milliseconds = none;
};

struct TableRow {
    std::string scene, method;
    std::string status;  ///< a verdict's name, or why there was no run
    std::size_t balls = 0;
    double seconds = 0;  ///< simulated: less than planned if it failed
    Measures measures;
};

/// The rows as CSV and as Markdown; `stamp`: lines for the head, machine, commit and command. The
/// only column that is a time says so in its name.
std::string csvOf(const std::vector<TableRow>& rows, const std::string& stamp);
std::string markdownOf(const std::vector<TableRow>& rows, const std::string& stamp);

/// How a run ended, for the measures that need no more than states.
struct RunRecord {
    const Scene& scene;
    double seconds = 0;     ///< simulated
    Spheres end;            ///< the last state
    Spheres secondBefore;   ///< the state a second before (the start, if there was less), ...
    double lastSecond = 0;  ///< ... so many s before
    bool metWalls = false;  ///< a ball may have bounced off one
    double collisions = Measures::none;  ///< impulses given, where they are counted
};

/// Overlaps, losses, momentum, and what kinetic theory or statics say of scenes of its kind.
void measureEnd(const RunRecord& run, Measures& measures);

/// Could a ball have met a wall in the last `dt` s?
bool mayHaveMetWall(const Spheres& spheres, Bounds walls, double dt);

}  // namespace ballpit::stability
