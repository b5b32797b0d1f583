// What the chart can measure: an engine's method, with its knobs. Engines differ in how they run a
// scene and in nothing else: scene, meter, clock and table are the same for all.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "common/scene.h"
#include "stability/map.h"
#include "stability/metrics.h"
#include "stability/question.h"

namespace ballpit::chart {

using stability::Cost;
using stability::Meter;
using stability::Verdict;

/// One setting of a method.
struct Knobs {
    double stepsAFrame = 1;  ///< a frame is Scene::dt; 0.5: one step for two frames
    int passes = 0;          ///< of what Runner::passesName says; 0: the method has none
    bool operator==(const Knobs&) const = default;
};

struct RunResult {
    Cost cost;                      ///< pair visits only with a meter, time only without
    Verdict verdict = Verdict::ok;  ///< what the engine itself reports: overflow, not finite
};

/// A method of an engine: a curve on the chart.
class Runner {
public:
    virtual ~Runner() = default;
    Runner() = default;
    Runner(const Runner&) = delete;
    Runner& operator=(const Runner&) = delete;

    virtual std::string engine() const = 0;      ///< "ballpit", "bullet 3.24"
    virtual std::string method() const = 0;      ///< "small-steps"; unique over all engines
    virtual std::string passesName() const = 0;  ///< "iterations", "substeps", or "" for none
    virtual Knobs usual() const = 0;             ///< what the engine does by itself, marked

    /// Beside the usual one: the passes worth trying, the steps a frame worth trying.
    virtual std::vector<int> passesToTry() const { return {}; }
    virtual std::vector<double> stepsToTry() const { return {0.5, 1, 2, 4, 8, 16, 32}; }

    /// A name that a setting is known by, or "".
    virtual std::string pointName(const Knobs&) const { return {}; }

    virtual bool canRun(const stability::Question&) const { return true; }

    /// s: with what step it moves the bodies (a substep, if it has them): for the meter.
    virtual double movingStep(const Scene& scene, const Knobs& knobs) const {
        return scene.dt / knobs.stepsAFrame;
    }

    /// Runs the scene for `seconds`, in whole steps.
    ///
    /// With a meter: no clock; the meter gets the state at the end of every frame (forEachStep says
    /// when), and the run ends early once it has failed. Pair visits are counted: listed pairs (or
    /// contact points) times passes over them, summed over the run.
    ///
    /// Without: the clock runs while the engine steps, and not while the world is made and warmed
    /// up; nothing else is done.
    virtual RunResult run(const Scene& scene, const Knobs& knobs, double seconds, Meter* meter) = 0;
};

using Runners = std::vector<std::unique_ptr<Runner>>;

/// All of a run's steps: `step()` makes one, `look(time)` follows where a frame ends (after each
/// step, if steps are longer than frames) and says whether to go on. Returns the simulated seconds.
template <class Step, class Look>
double forEachStep(const Scene& scene, const Knobs& knobs, double seconds, Step step, Look look) {
    const double dt = scene.dt / knobs.stepsAFrame;
    const long steps = stability::wholeSteps(seconds, dt);
    const long stepsALook = std::max(1L, std::lround(knobs.stepsAFrame));
    for (long k = 1; k <= steps; ++k) {
        step();
        const bool frameEnds = k % stepsALook == 0 || k == steps;
        if (frameEnds && !look(static_cast<double>(k) * dt)) return static_cast<double>(k) * dt;
    }
    return static_cast<double>(steps) * dt;
}

/// This engine's methods.
Runners ourRunners(Device device);

/// Other engines': those that this build has, and for each that it has not a line that names the
/// package.
struct Peers {
    Runners runners;
    std::vector<std::string> missing;
};
Peers peerRunners();

}  // namespace ballpit::chart
