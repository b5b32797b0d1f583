// A failure map: for a method, which cells of a plane of two knobs hold, and how the others fail.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/device.h"

namespace ballpit::stability {

enum class Verdict {
    ok,          ///< as near to the truth as the map asks
    inaccurate,  ///< farther from it
    energy,      ///< energy from nowhere
    lost,        ///< a ball left the world, or passed through another
    overflow,    ///< more pairs than balls without overlap could have
    notFinite    ///< a body is no longer a number
};

/// "ok", "inaccurate", "energy", "lost", "overflow", "not finite".
const char* name(Verdict verdict);

struct Outcome {
    Verdict verdict;
    double value;  ///< what the map measures; NaN where there is nothing to measure
};

struct Axis {
    std::string label;  ///< with its unit
    std::vector<double> values;
};

/// A prediction, as points (x, y).
struct Line {
    std::string label;
    std::vector<std::pair<double, double>> points;
};

/// One plane, for one method.
struct Panel {
    std::string name;
    Axis x, y;
    std::function<Outcome(double x, double y)> run;
    std::vector<Line> lines;
};

struct Map {
    std::string name, title;
    std::string ok;     ///< when a cell is ok
    std::string value;  ///< what Outcome::value is
    std::vector<Panel> panels;
};

struct MapOptions {
    Device device = Device::cpu;
    bool coarse = false;  ///< few cells, small scenes: for a check that the boundaries are there
};

/// The points (x, f(x)) for many x between the axis' ends, where f is a finite number.
Line lineOver(const Axis& x, const std::string& label, const std::function<double(double)>& f);

/// A straight line at one x, over all of y.
Line lineAt(double x, const Axis& y, const std::string& label);

std::size_t cellCount(const Map& map);

}  // namespace ballpit::stability
