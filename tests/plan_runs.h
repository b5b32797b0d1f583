// What the tests of the plan measure: the error and the work of a run, with a plan and without.
#pragma once

#include <functional>
#include <optional>

#include "12_speed_and_accuracy/planned_run.cuh"
#include "12_speed_and_accuracy/tolerance.h"
#include "common/with_threads.h"
#include "stability/question.h"
#include "stability/scenes.h"
#include "stability/trial.cuh"
#include "tests/support.h"

namespace ballpit::test {

/// One start of a question.
struct Start {
    const stability::Question* question;
    Scene scene;
    double seconds;
};

/// What is met by luck is no proof, so a question has several starts: other seeds; other speeds of
/// the bullet, which has no seed; frames twice as long for the gas that cools.
using Starts = std::vector<Start>;

inline bool hasSeeds(const stability::Question& question) {
    const Scene a = question.make(1), b = question.make(2);
    return bitsOf(a.spheres.positions) != bitsOf(b.spheres.positions) ||
           bitsOf(a.spheres.velocities) != bitsOf(b.spheres.velocities);
}

inline Starts startsOf(const stability::Question& question) {
    Starts starts;
    if (question.scene == std::string("bullet")) {
        for (const float travel : {2.0f, 2.25f, 2.5f, 2.75f, 3.0f, 3.3f, 3.6f, 4.0f})
            starts.push_back({&question, stability::makeBullet(5, travel),
                              question.seconds * 3.0 / static_cast<double>(travel)});
        return starts;
    }
    if (question.scene == std::string("cooling_gas")) {
        for (const float travel : {0.1f, 0.2f})
            for (const std::uint64_t seed : {1, 2})
                starts.push_back(
                    {&question,
                     stability::makeGasOf(
                         {.count = 1000, .travel = travel, .restitution = 0.9f, .seed = seed}),
                     question.seconds});
        return starts;
    }
    starts.push_back({&question, question.make(1), question.seconds});
    if (hasSeeds(question)) starts.push_back({&question, question.make(2), question.seconds});
    return starts;
}

/// What a run takes, counted, so that it is the same on every machine: visits of listed pairs
/// (times passes over them), and moves of balls (each with its walls, and mostly a look for
/// partners).
struct Work {
    double visits = 0, moves = 0;
    Work& operator+=(Work other) {
        visits += other.visits;
        moves += other.moves;
        return *this;
    }
    Work operator-(Work other) const { return {visits - other.visits, moves - other.moves}; }
    Work operator/(double by) const { return {visits / by, moves / by}; }
};

/// May a run that has done so much still turn out much cheaper than `most`?
using StillOf = std::function<bool(Work)>;

struct Run {
    double error = 0;
    Work work;
    bool failed = false;
};

/// The same of all starts of a question.
struct Verdict {
    bool meets = true;
    double worst = 0;
    Work work;
};

/// Runs all starts, until one has missed or too much work is done: `run(start, goesOn)`.
template <class RunStart>
Verdict overAll(const Starts& starts, double tolerance, const StillOf& goesOn, RunStart run) {
    Verdict verdict;
    for (const Start& start : starts) {
        const Work before = verdict.work;
        const Run one = run(start, [&](Work work) { return goesOn(work += before); });
        verdict.meets = !one.failed && one.error <= tolerance;
        verdict.worst = std::max(verdict.worst, one.error);
        verdict.work += one.work;
        if (!verdict.meets) break;
    }
    return verdict;
}

inline Work workOfStep(PhysicsSimulator& simulator) {
    const StepStats stats = simulator.step();
    const SimulatorSettings& s = simulator.settings();
    return {stability::visitsOf(stats, s), double(*s.substeps) * s.objects};
}

/// Runs a start: `frame(simulator)` makes all steps of a frame and returns their work.
template <class Frame>
Run runFrames(const Start& start, PhysicsSimulator& simulator, double dt, const StillOf& goesOn,
              Frame frame) {
    const WithThreads one(1);  // for so few balls a second thread costs more than it brings
    const auto meter = start.question->meter(start.scene, dt);
    const double length = start.scene.dt;
    const long frames = stability::wholeSteps(start.seconds, length);
    Run run;
    try {
        for (long k = 1; k <= frames && !meter->hasFailed() && goesOn(run.work); ++k) {
            run.work += frame(simulator);
            meter->add(simulator.bodies().download(), static_cast<double>(k) * length);
        }
        run.failed = meter->hasFailed() || !goesOn(run.work);
        run.error = meter->error();
    } catch (const std::runtime_error&) {
        run.failed = true;
    }
    return run;
}

/// The plan of a scene at its start.
inline Plan planOf(const Scene& scene, double tolerance = usualTolerance,
                   const PlanThresholds& thresholds = {}) {
    return makePlan(factsOf(scene, Device::cpu), worldOf(scene), tolerance, thresholds);
}

inline bool always(Work) { return true; }

/// With settings that stay as they are.
inline Run runWith(const Start& start, SimulatorSettings settings, int stepsAFrame,
                   const StillOf& goesOn = always) {
    settings.dt = start.scene.dt / static_cast<float>(stepsAFrame);
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(start.scene.spheres);
    const double dt = settings.dt / static_cast<float>(*simulator.settings().substeps);
    return runFrames(start, simulator, dt, goesOn, [&](PhysicsSimulator& s) {
        Work work;
        for (int k = 0; k < stepsAFrame; ++k) work += workOfStep(s);
        return work;
    });
}

/// With a plan, that is read again as `gravity_fall` does.
inline Run runPlanned(const Start& start, double tolerance, const PlanThresholds& thresholds = {},
                      const StillOf& goesOn = always) {
    PhysicsSimulator simulator(ballpit::settingsFor(start.scene, Device::cpu));
    simulator.bodies().upload(start.scene.spheres);
    Planner planner(simulator, start.scene, tolerance, thresholds);
    const double dt = simulator.settings().dt / static_cast<float>(*simulator.settings().substeps);
    return runFrames(start, simulator, dt, goesOn, [&](PhysicsSimulator& s) {
        Work work;
        planner.frame([&] { work += workOfStep(s); });
        return work;
    });
}

}  // namespace ballpit::test
