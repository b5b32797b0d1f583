// Runs a scene of the catalogue under a method, three times, and fills in a row of the table: once
// with everything measured, once with the clock running and nothing else, and once more to see
// whether it comes to the same.
#pragma once

#include <algorithm>
#include <memory>

#include "stability/catalogue.h"
#include "stability/counted.cuh"
#include "stability/question.h"
#include "stability/table.h"

namespace ballpit::stability {

/// What is asked of a scene; null if nothing is.
inline const Question* questionOf(const std::string& scene) {
    const std::span<const Question> all = questions();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Question& q) { return q.scene == scene; });
    return found == all.end() ? nullptr : &*found;
}

/// A scene, how long it runs, and under which settings.
struct TableRun {
    const Question* question;
    Scene scene;
    SimulatorSettings settings;
    double seconds;

    long steps() const { return wholeSteps(seconds, scene.dt); }
    double movingStep() const { return scene.dt / static_cast<double>(*knobs().substeps); }

private:
    ResponseKnobs knobs() const {
        return completed(settings.response, settings, length(scene.gravity), scene.dt);
    }
};

inline TableRun tableRun(const Entry& entry, ResponseMethod method, Device device) {
    constexpr double secondsWithoutQuestion = 1;
    constexpr std::uint64_t seed = 1;
    const Question* question = questionOf(entry.name);
    Scene scene = question ? question->make(seed) : entry.make(entry.usualCount, seed);
    for (float& e : scene.spheres.restitutions) e = std::max(e, dullest(method));
    const SimulatorSettings settings = settingsWith(scene, device, method);
    return {question, scene, settings, question ? question->seconds : secondsWithoutQuestion};
}

/// Runs with everything measured. Returns how it ended; the measures of the end are left empty if
/// it broke off. (Written as a class, since what was measured before that counts.)
class MeasuredRun {
public:
    explicit MeasuredRun(const TableRun& run)
        : run_(run), record_{run.scene}, drift_(energyOf(run.scene.spheres)) {
        record_.end = record_.secondBefore = run.scene.spheres;
        if (run.question) meter_ = run.question->meter(run.scene, run.movingStep());
    }

    double seconds() const { return record_.seconds; }

    Verdict go(Measures& m) {
        const Outcome outcome = outcomeOf([&]() -> Outcome {
            if (run_.settings.response == ResponseMethod::coloured) {
                CountedTrial trial(run_.scene, run_.settings);
                advance(trial, m);
                record_.collisions = trial.collisions();
            } else {
                Trial trial(run_.scene, run_.settings);
                advance(trial, m);
            }
            return {Verdict::ok, 0};
        });
        m.driftMean = drift_.mean();
        m.driftLargest = drift_.largest();
        if (outcome.verdict == Verdict::notFinite || outcome.verdict == Verdict::overflow)
            return outcome.verdict;
        measureEnd(record_, m);
        if (!meter_) return m.lost > 0 ? Verdict::lost : Verdict::ok;
        m.error = meter_->error();
        m.within = run_.question->tolerance;
        if (meter_->hasFailed()) return meter_->verdict();
        return m.error <= m.within ? Verdict::ok : Verdict::inaccurate;
    }

private:
    double energyOf(const Spheres& now) const {
        const Scene& s = run_.scene;
        return shadowEnergyOf(now, s.bounds, s.gravity, static_cast<float>(run_.movingStep()));
    }

    void advance(Trial& trial, Measures& m) {
        const long steps = run_.steps();
        const long secondBefore = std::max(0L, steps - std::lround(1 / run_.scene.dt));
        const auto dt = double(run_.scene.dt);
        double visits = 0;
        for (long k = 1; k <= steps; ++k) {
            visits += visitsOf(trial.step(), trial.settings());
            record_.seconds = static_cast<double>(k) * dt;
            record_.end = trial.state();
            observe();
            if (k == secondBefore) record_.secondBefore = record_.end;
            if (meter_ && meter_->hasFailed()) break;
        }
        record_.lastSecond =
            record_.seconds - std::min(record_.seconds, static_cast<double>(secondBefore) * dt);
        m.pairVisits = visits / record_.seconds;
    }

    void observe() {
        if (meter_) meter_->add(record_.end, record_.seconds);
        drift_.add(energyOf(record_.end));
        record_.metWalls |=
            !run_.scene.periodic && mayHaveMetWall(record_.end, run_.scene.bounds, run_.scene.dt);
    }

    const TableRun& run_;
    RunRecord record_;
    EnergyDrift drift_;
    std::unique_ptr<Meter> meter_;
};

/// Runs with nothing but the clock. The state at the end, if it gets there.
inline Spheres timedRun(const TableRun& run, double& milliseconds) {
    PhysicsSimulator simulator(run.settings);
    simulator.bodies().upload(run.scene.spheres);
    milliseconds = 0;
    for (long k = run.steps(); k > 0; --k) milliseconds += simulator.step().frameTimeMs;
    return simulator.bodies().download();
}

/// The same once more: on a CPU with the threads' work turned around, so that a result that depends
/// on the order shows it; on a GPU the order is a matter of chance anyway.
inline Spheres repeatedRun(const TableRun& run) {
    const LaunchOrder before = launchOrder();
    launchOrder() = LaunchOrder::reversed;
    double milliseconds;
    const Spheres end = timedRun(run, milliseconds);
    launchOrder() = before;
    return end;
}

inline TableRow rowOf(const Entry& entry, ResponseMethod method, Device device) {
    const TableRun run = tableRun(entry, method, device);
    TableRow row{entry.name, name(method), "", run.scene.spheres.count(), run.seconds, {}};
    Measures& m = row.measures;
    MeasuredRun measured(run);
    const Verdict verdict = measured.go(m);
    row.seconds = measured.seconds();
    row.status = name(verdict);
    if (verdict == Verdict::notFinite || verdict == Verdict::overflow) return row;
    outcomeOf([&]() -> Outcome {
        double milliseconds;
        const Spheres once = timedRun(run, milliseconds), again = repeatedRun(run);
        // A run that failed on the way is no faster for that: it gets no time.
        if (verdict == Verdict::ok || verdict == Verdict::inaccurate)
            m.milliseconds = milliseconds / run.seconds;
        m.repeatDistance = largestDistance(once, again);
        m.sameBits = sameBits(once, again) ? 1 : 0;
        return {Verdict::ok, 0};
    });
    return row;
}

}  // namespace ballpit::stability
