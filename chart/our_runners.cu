// This engine's methods as runners, racy and atomic exhibits included.
#include "chart/runner.h"
#include "common/error.h"
#include "common/timing.h"
#include "common/with_threads.h"
#include "stability/trial.cuh"

namespace ballpit::chart {

namespace {

using stability::Trial;

/// A trial that can say how long its pair list was.
class CountedTrial : public Trial {
public:
    using Trial::Trial;
    double listedPairs() { return pairs_.starts.download().back(); }
    double passesAStep() const { return double(*settings_.iterations) * *settings_.substeps; }
};

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
        // A second thread for lists of pairs alone gains little, and loses all of it where another
        // program wants a core, too.
        const WithThreads threads(
            given.spheres.count() < std::size_t(serialCount) ? 1 : cpuThreadCount());
        Scene scene = given;
        // A spring and dashpot cannot stop a ball dead.
        for (float& e : scene.spheres.restitutions) e = std::max(e, stability::dullest(method_));
        scene.dt = static_cast<float>(given.dt / knobs.stepsAFrame);
        CountedTrial trial(scene, stability::settingsWith(scene, device_, method_, knobs.passes));
        try {
            return meter ? metered(trial, given, knobs, seconds, *meter)
                         : timed(trial, given, knobs, seconds);
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

private:
    static RunResult metered(CountedTrial& trial, const Scene& scene, const Knobs& knobs,
                             double seconds, Meter& meter) {
        RunResult result;
        const auto step = [&] {
            trial.step();
            result.cost.pairVisits += trial.listedPairs() * trial.passesAStep();
        };
        const auto look = [&](double time) {
            meter.add(trial.state(), time);
            return !meter.hasFailed();
        };
        result.cost.simulatedSeconds = forEachStep(scene, knobs, seconds, step, look);
        return result;
    }

    RunResult timed(CountedTrial& trial, const Scene& scene, const Knobs& knobs, double seconds) {
        RunResult result;
        trial.rehearseStep();  // allocates, and records a CUDA graph
        synchronize(device_);
        const double start = milliseconds();
        result.cost.simulatedSeconds = forEachStep(
            scene, knobs, seconds, [&] { trial.step(); }, [](double) { return true; });
        synchronize(device_);
        result.cost.milliseconds = milliseconds() - start;
        return result;
    }

    ResponseMethod method_;
    Device device_;
};

}  // namespace

Runners ourRunners(Device device) {
    Runners runners;
    for (const ResponseMethod method : stability::allMethods())
        runners.push_back(std::make_unique<OurRunner>(method, device));
    return runners;
}

}  // namespace ballpit::chart
