// Measures points.
#include "chart/measure.h"

#include <algorithm>

#include "common/progress.h"
#include "common/timing.h"
#include "common/words.h"

namespace ballpit::chart {

namespace {

using stability::Question;

/// ms: shorter runs are made again until they are this long together, or the clock shows noise.
constexpr double leastSample = 20, leastQuickSample = 5;
/// s: a point that takes longer gets fewer timed runs, but never fewer than three.
constexpr double enoughTime = 10, enoughQuickTime = 1;
constexpr int fewestRuns = 3;
/// ms: longer samples need no warm-up.
constexpr double longEnoughToWarm = 500, longEnoughQuickly = 50;

std::string shortNumber(double value) { return withDigits(value, 3); }

std::string labelOf(const Runner& runner, const Setting& setting, double dt) {
    const std::string name = runner.pointName(setting.knobs);
    if (!name.empty()) return name;
    std::string label = "dt " + shortNumber(1000 * dt) + " ms";
    if (!runner.passesName().empty())
        label += ", " + std::to_string(setting.knobs.passes) + " " + runner.passesName();
    return label;
}

std::string commandOf(const Question& question, const Runner& runner, const Knobs& knobs,
                      const Sweep& sweep) {
    std::string command = std::string("./ballpit chart --scene ") + question.scene + " --method " +
                          runner.method() + " --steps " + shortNumber(knobs.stepsAFrame);
    if (knobs.passes > 0) command += " --passes " + std::to_string(knobs.passes);
    return command + sweep.further;
}

/// One sample: as many runs as it takes to be longer than noise. Nothing but a verdict if one
/// fails.
RunResult sample(const Question& question, Runner& runner, const Knobs& knobs, const Scene& scene,
                 bool quick) {
    RunResult sum;
    while (sum.cost.milliseconds < (quick ? leastQuickSample : leastSample)) {
        const RunResult run = runner.run(scene, knobs, question.seconds, nullptr);
        if (run.verdict != Verdict::ok) return run;
        sum.cost.milliseconds += run.cost.milliseconds;
        sum.cost.simulatedSeconds += run.cost.simulatedSeconds;
    }
    return sum;
}

/// Fills in the times of a row whose result is right.
void timeRow(Row& row, const Question& question, Runner& runner, const Scene& scene,
             const Sweep& sweep) {
    std::vector<double> times;
    double spent = 0;
    bool isWarm = false;
    while (static_cast<int>(times.size()) < sweep.runs) {
        const bool isLong = spent > 1e3 * (sweep.quick ? enoughQuickTime : enoughTime);
        if (isLong && static_cast<int>(times.size()) >= fewestRuns) break;
        if (StopRequest::received()) return;
        const RunResult run = sample(question, runner, row.knobs, scene, sweep.quick);
        if (run.verdict != Verdict::ok) {  // right the first time and wrong the second: a race
            row.verdict = name(run.verdict);
            return;
        }
        spent += run.cost.milliseconds;
        // The first short one is a warm-up; a long one has been warm for most of its time.
        if (isWarm || run.cost.milliseconds > (sweep.quick ? longEnoughQuickly : longEnoughToWarm))
            times.push_back(run.cost.millisecondsASecond());
        isWarm = true;
    }
    std::sort(times.begin(), times.end());
    row.milliseconds = {median(times), times.front(), times.back()};
    row.runs = static_cast<int>(times.size());
}

}  // namespace

std::vector<Setting> settingsToTry(const Runner& runner, bool quick) {
    constexpr double mostQuickSteps = 4;
    const Knobs usual = runner.usual();
    std::vector<Setting> settings{{usual, "both"}};
    for (const double steps : runner.stepsToTry())
        if (steps != usual.stepsAFrame && !(quick && steps > mostQuickSteps))
            settings.push_back({{steps, usual.passes}, "dt"});
    bool skip = true;
    for (const int passes : runner.passesToTry()) {
        if (passes == usual.passes || (quick && (skip = !skip))) continue;
        settings.push_back({{usual.stepsAFrame, passes}, runner.passesName()});
    }
    return settings;
}

Row emptyRow(const Question& question, const Runner& runner, const Setting& setting,
             const Sweep& sweep) {
    Row row{.scene = question.scene, .engine = runner.engine(), .method = runner.method()};
    row.curve = setting.curve;
    row.knobs = setting.knobs;
    row.dt = question.make(sweep.seed).dt / setting.knobs.stepsAFrame;
    row.passesName = runner.passesName();
    row.label = labelOf(runner, setting, row.dt);
    row.tolerance = question.tolerance;
    row.command = commandOf(question, runner, setting.knobs, sweep);
    return row;
}

std::optional<Row> measuredRow(const Question& question, Runner& runner, const Setting& setting,
                               const Sweep& sweep) {
    Row row = emptyRow(question, runner, setting, sweep);
    const Scene scene = question.make(sweep.seed);
    const auto meter = question.meter(scene, runner.movingStep(scene, setting.knobs));
    const RunResult run = runner.run(scene, setting.knobs, question.seconds, meter.get());
    const Verdict verdict = run.verdict != Verdict::ok ? run.verdict : meter->verdict();
    row.verdict = name(verdict);
    if (run.cost.simulatedSeconds > 0) row.pairVisits = run.cost.pairVisitsASecond();
    if (verdict != Verdict::notFinite && run.verdict == Verdict::ok) row.error = meter->error();
    if (verdict == Verdict::ok) timeRow(row, question, runner, scene, sweep);
    if (StopRequest::received()) return std::nullopt;
    return row;
}

double probe(const Question& question, Runner& runner, const Sweep& sweep) {
    constexpr double probeFrames = 8;
    constexpr int tries = 3;
    const Scene scene = question.make(sweep.seed);
    double least = std::numeric_limits<double>::max();
    for (int k = 0; k < tries; ++k) {
        const RunResult run = runner.run(scene, runner.usual(), probeFrames * scene.dt, nullptr);
        if (run.verdict != Verdict::ok) return 0;  // it will break off as soon in the chart
        least = std::min(least, run.cost.millisecondsASecond());
    }
    return least;
}

double expectedSeconds(const Question& question, const Runner& runner, const Setting& setting,
                       const Sweep& sweep, double millisecondsASecond) {
    const Knobs usual = runner.usual();
    const double passes = std::max(1, setting.knobs.passes) / double(std::max(1, usual.passes));
    // Finding the pairs is about half of the work, and does not grow with the passes.
    const double work = setting.knobs.stepsAFrame / usual.stepsAFrame * (0.5 + 0.5 * passes);
    const double run = 1e-3 * millisecondsASecond * work * question.seconds;
    const double least = 1e-3 * (sweep.quick ? leastQuickSample : leastSample);
    return 2 * run + (run > 1 ? fewestRuns : sweep.runs + 1) * std::max(run, least);
}

}  // namespace ballpit::chart
