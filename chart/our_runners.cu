// This engine's methods as runners, racy and atomic exhibits included.
#include "12_speed_and_accuracy/planned_run.cuh"
#include "12_speed_and_accuracy/tolerance.h"
#include "chart/runner.h"
#include "common/error.h"
#include "common/timing.h"
#include "common/with_threads.h"
#include "stability/trial.cuh"

namespace ballpit::chart {

namespace {

using stability::Trial;

/// A second thread for lists of pairs alone gains little, and loses all of it where another program
/// wants a core, too.
int threadsFor(const Scene& scene) {
    return scene.spheres.count() < std::size_t(serialCount) ? 1 : cpuThreadCount();
}

/// What `run` returns, or the engine's own verdict.
template <class Run>
RunResult resultOf(Run run) {
    try {
        return run();
    } catch (const InputError&) {
        throw;
    } catch (const CudaError&) {
        throw;
    } catch (const NotFiniteError&) {
        return {.verdict = Verdict::notFinite};
    } catch (const std::runtime_error&) {
        return {.verdict = Verdict::overflow};
    }
}

/// Makes all steps, with a meter or with a clock (Runner::run). `step(visits)` makes one and adds
/// the pairs it visited to `visits`, if there is one.
template <class Step>
RunResult runSteps(Trial& trial, const Scene& scene, const Knobs& knobs, double seconds,
                   Meter* meter, Step step) {
    RunResult result;
    double* visits = meter ? &result.cost.pairVisits : nullptr;
    trial.rehearseStep();  // allocates, and records a CUDA graph
    synchronize(trial.settings().device);
    const double start = milliseconds();
    result.cost.simulatedSeconds = forEachStep(
        scene, knobs, seconds, [&] { step(visits); },
        [&](double time) {
            if (meter) meter->add(trial.state(), time);
            return !meter || !meter->hasFailed();
        });
    synchronize(trial.settings().device);
    if (!meter) result.cost.milliseconds = milliseconds() - start;
    return result;
}

void makeStep(Trial& trial, double* visits) {
    const StepStats stats = trial.step();
    if (visits) *visits += stability::visitsOf(stats, trial.settings());
}

class OurRunner : public Runner {
public:
    OurRunner(ResponseMethod method, Device device) : method_(method), device_(device) {}

    std::string engine() const override { return "ballpit"; }
    std::string method() const override { return name(method_); }
    std::string passesName() const override {
        return stability::movesInSubsteps(method_) ? "substeps" : "iterations";
    }
    Knobs usual() const override {
        const ResponseKnobs knobs = completed(method_, {}, 0, 1);
        return {1, stability::movesInSubsteps(method_) ? *knobs.substeps : *knobs.iterations};
    }
    std::string pointName(const Knobs& knobs) const override {
        const bool isOriginal = method_ == ResponseMethod::massSplit && knobs == usual();
        return isOriginal ? "original loop" : "";
    }
    std::vector<int> passesToTry() const override { return {1, 2, 4, 8, 16, 32}; }

    double movingStep(const Scene& scene, const Knobs& knobs) const override {
        const double dt = Runner::movingStep(scene, knobs);
        return stability::movesInSubsteps(method_) ? dt / knobs.passes : dt;
    }

    RunResult run(const Scene& given, const Knobs& knobs, double seconds, Meter* meter) override {
        const WithThreads threads(threadsFor(given));
        Scene scene = given;
        // A spring and dashpot cannot stop a ball dead.
        for (float& e : scene.spheres.restitutions) e = std::max(e, stability::dullest(method_));
        scene.dt = static_cast<float>(given.dt / knobs.stepsAFrame);
        Trial trial(scene, stability::settingsWith(scene, device_, method_, knobs.passes));
        return resultOf([&] {
            return runSteps(trial, given, knobs, seconds, meter,
                            [&](double* visits) { makeStep(trial, visits); });
        });
    }

private:
    ResponseMethod method_;
    Device device_;
};

/// What gravity_fall does by itself: the plan for the scene and its tolerance, made anew as the
/// scene changes. Planning is part of its time.
class PlannedRunner : public Runner {
public:
    explicit PlannedRunner(Device device) : device_(device) {}

    std::string engine() const override { return "ballpit"; }
    std::string method() const override { return "plan"; }
    std::string passesName() const override { return ""; }
    Knobs usual() const override { return {1, 0}; }
    std::vector<double> stepsToTry() const override { return {}; }
    std::string pointName(const Knobs&) const override { return "plan"; }

    /// Of the plan that is made first.
    double movingStep(const Scene& scene, const Knobs&) const override {
        const Plan plan =
            makePlan(factsOf(scene, device_), worldOf(scene), toleranceOf(scene.name));
        return scene.dt / double(plan.stepsAFrame) / plan.knobs.substeps.value_or(1);
    }

    RunResult run(const Scene& scene, const Knobs& knobs, double seconds, Meter* meter) override {
        const WithThreads threads(threadsFor(scene));
        Trial trial(scene, stability::settingsWith(scene, device_, ResponseMethod::massSplit));
        return resultOf([&] {
            Planner planner(trial, scene, toleranceOf(scene.name));
            return runSteps(trial, scene, knobs, seconds, meter, [&](double* visits) {
                planner.frame([&] { makeStep(trial, visits); });
            });
        });
    }

private:
    Device device_;
};

}  // namespace

Runners ourRunners(Device device) {
    Runners runners;
    for (const ResponseMethod method : stability::allMethods())
        runners.push_back(std::make_unique<OurRunner>(method, device));
    runners.push_back(std::make_unique<PlannedRunner>(device));
    return runners;
}

}  // namespace ballpit::chart
