// One point of the chart as a line of CSV, there and back.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "chart/runner.h"

namespace ballpit::chart {

constexpr double notMeasured = std::numeric_limits<double>::quiet_NaN();

/// The values of several timed runs.
struct Spread {
    double median = notMeasured, low = notMeasured, high = notMeasured;
};

struct Row {
    std::string scene, engine, method;
    std::string curve;  ///< "dt", the name of the passes, or "both" for the usual setting
    Knobs knobs;
    double dt = 0;  ///< s
    std::string passesName, label;
    double error = notMeasured, tolerance = 0;
    std::string verdict;
    Spread milliseconds;              ///< a simulated second
    double pairVisits = notMeasured;  ///< a simulated second
    int runs = 0;                     ///< timed; 0 for a wrong result
    bool onFront = false;             ///< of speed and error
    bool onFrontOfVisits = false;     ///< of pair visits and error
    std::string command;              ///< that repeats it

    double realTimeFactor() const { return 1000 / milliseconds.median; }
    bool isGood() const { return verdict == "ok"; }
};

/// The names of the columns.
extern const char* const rowHeader;

std::string lineOf(const Row& row);

/// Nothing if the line is no row: torn, or of another version.
std::optional<Row> rowOf(const std::string& line);

/// Fills in onFront and onFrontOfVisits of the rows of one scene.
void markFronts(std::vector<Row>& rows);

}  // namespace ballpit::chart
