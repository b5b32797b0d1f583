// A run of ballpit_chart, from what was asked for to the files.
#pragma once

#include "chart/measure.h"

namespace ballpit::chart {

struct Asked {
    std::vector<std::string> scenes, methods;
    Sweep sweep;
    bool peers = false, printQuestions = false;
    Device device = Device::cpu;
    std::optional<double> steps;  ///< with `passes`: one point, which is printed and not written
    std::optional<int> passes;
    std::string out = ".", stamp;
};

/// Returns the exit code. InputError for a scene, method or folder that there is not.
int runChart(const Asked& asked);

/// The text of a finished chart_SCENE.csv.
std::string chartText(const stability::Question& question, const std::string& head,
                      std::vector<Row> rows);

}  // namespace ballpit::chart
