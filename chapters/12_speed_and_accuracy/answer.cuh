// A scene's question, and how it is answered by a loop: chapter 07's, another one, or the plan's.
// What is wrong with the answer is read by the chart's meters, which the chapter's errors are a
// part of. What it costs is counted, not timed: so it is the same on every machine.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "12_speed_and_accuracy/pareto_front.h"
#include "12_speed_and_accuracy/planned_run.cuh"
#include "12_speed_and_accuracy/tolerance.h"
#include "common/metrics.h"
#include "common/options.h"
#include "stability/question.h"
#include "stability/trial.cuh"

namespace ballpit {

/// A method with its passes (or substeps) and steps a frame; without a method, what the plan says.
struct Loop {
    std::string name;
    std::optional<ResponseMethod> method;
    int passes = 0;  ///< 0: as many as the method has by itself
    int stepsAFrame = 1;
};

/// The original design's: split masses, 2 rounds, a step a frame.
inline Loop originalLoop() { return {"original loop", ResponseMethod::massSplit}; }
inline Loop plannedLoop() { return {"plan", std::nullopt}; }

struct Answer {
    double error = 0;
    double visits = 0;  ///< listed pairs times passes over them, in a simulated second
    stability::Verdict verdict = stability::Verdict::ok;
    std::string settings, hash;

    bool hasFailed() const { return verdict != stability::Verdict::ok; }
    /// Its place on the chart. Who visits no pair at all is infinitely fast.
    WorkPoint point() const { return {1 / visits, error, hasFailed()}; }
};

/// One run: a simulator in its scene, and what it has done.
class Course {
public:
    Course(const stability::Question& question, const Loop& loop, const Options& options)
        : scene_(question.make(options.seed)),
          stepsAFrame_(loop.stepsAFrame),
          simulator_(settingsOf(loop, options.device)) {
        simulator_.bodies().upload(scene_.spheres);
        if (!loop.method) planner_.emplace(simulator_, scene_, toleranceOf(question.scene));
        const ResponseKnobs& knobs = simulator_.settings();
        meter_ =
            question.meter(scene_, double(simulator_.settings().dt) / knobs.substeps.value_or(1));
        settings_ = inShort(simulator_.settings());
    }

    Answer after(double seconds) {
        const long frames = stability::wholeSteps(seconds, scene_.dt);
        long done = 0;
        while (done < frames && !meter_->hasFailed()) advance(++done);
        const double simulated = static_cast<double>(done) * scene_.dt;
        const std::string hash = hashText(stateHash(simulator_.bodies().download()));
        return {meter_->error(), visits_ / simulated, meter_->verdict(), settings_, hash};
    }

    /// ms that a simulated second takes. Nobody reads errors meanwhile.
    double millisecondsASecond(double seconds) {
        const long frames = stability::wholeSteps(seconds, scene_.dt);
        double sum = 0;
        for (long k = 0; k < frames; ++k) makeFrame([&] { sum += simulator_.step().frameTimeMs; });
        return sum / (static_cast<double>(frames) * scene_.dt);
    }

private:
    SimulatorSettings settingsOf(const Loop& loop, Device device) const {
        Scene scene = scene_;
        scene.dt = scene_.dt / static_cast<float>(loop.stepsAFrame);
        if (!loop.method) return settingsFor(scene, device);
        return stability::settingsWith(scene, device, *loop.method, loop.passes);
    }

    /// All of a frame's steps.
    template <class Step>
    void makeFrame(Step step) {
        if (planner_)
            planner_->frame(step);
        else
            for (int k = 0; k < stepsAFrame_; ++k) step();
    }

    void advance(long frame) {
        makeFrame(
            [&] { visits_ += stability::visitsOf(simulator_.step(), simulator_.settings()); });
        meter_->add(simulator_.bodies().download(), static_cast<double>(frame) * scene_.dt);
    }

    Scene scene_;
    int stepsAFrame_;
    PhysicsSimulator simulator_;
    std::optional<Planner> planner_;
    std::unique_ptr<stability::Meter> meter_;
    std::string settings_;
    double visits_ = 0;
};

/// A run that breaks off has no answer.
inline Answer answerOf(const stability::Question& question, const Loop& loop,
                       const Options& options) {
    try {
        return Course(question, loop, options).after(question.seconds);
    } catch (const NotFiniteError&) {
        return {.verdict = stability::Verdict::notFinite};
    }
}

}  // namespace ballpit
