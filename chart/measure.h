// Which points a chart has, and how one is measured: first the error, without a clock; then, if the
// result is not wrong, the time, without a meter.
#pragma once

#include "chart/row.h"

namespace ballpit::chart {

struct Sweep {
    bool quick = false;
    std::uint64_t seed = 1;
    int runs = 5;         ///< timed
    std::string further;  ///< options that the command of a point needs as well
};

/// One setting of one method.
struct Setting {
    Knobs knobs;
    std::string curve;
};

/// The steps with the usual passes, the passes with the usual step. Quick: fewer of both.
std::vector<Setting> settingsToTry(const Runner& runner, bool quick);

/// What identifies the point, and nothing measured yet.
Row emptyRow(const stability::Question& question, const Runner& runner, const Setting& setting,
             const Sweep& sweep);

/// The whole point; nothing if the user stopped it.
std::optional<Row> measuredRow(const stability::Question& question, Runner& runner,
                               const Setting& setting, const Sweep& sweep);

/// s: what the point will take, judging from a few frames of it at its usual setting that took
/// `millisecondsASecond` for a simulated second.
double expectedSeconds(const stability::Question& question, const Runner& runner,
                       const Setting& setting, const Sweep& sweep, double millisecondsASecond);

/// ms a simulated second at the usual setting, from a few frames.
double probe(const stability::Question& question, Runner& runner, const Sweep& sweep);

}  // namespace ballpit::chart
