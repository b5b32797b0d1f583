// Chapter 10: a run from scene to summary, with a film of it, a window, or both.
#pragma once

#include "10_full_system/viewer.h"
#include "10_full_system/window_feed.cuh"
#include "12_speed_and_accuracy/planned_run.cuh"
#include "12_speed_and_accuracy/tolerance.h"
#include "common/csv.h"
#include "common/film.h"
#include "common/progress.h"
#include "common/summary.h"

namespace ballpit {

/// The film that --out and --png ask for. A window beside it changes nothing in it.
class OrderedFilm {
public:
    OrderedFilm(const Options& options, const Scene& scene)
        : options_(options), film_(options, scene.bounds) {}

    /// Will the next step's times be shown?
    bool wantsTimes() const { return hasLedger() && options_.ledgerTimes; }

    void stepDone(Observation& now) {
        if (!film_.isRolling()) return;
        film_.capture(now.bodies(), now.radii(), now.colors(coloringNamed(options_.color)),
                      textOver(now));
    }

    void finish() { film_.finish(); }

private:
    bool hasLedger() const { return film_.isRolling() && options_.ledger; }

    std::string textOver(Observation& now) {
        if (!hasLedger()) return {};
        now.writeInto(ledger_);
        if (recordingMeasures(now.step(), now.count())) ledger_.figures = now.figures();
        return ledgerText(ledger_, options_.ledgerTimes);
    }

    const Options& options_;
    Film film_;
    Ledger ledger_;
};

/// What moves the scene: a simulator, and a planner that tells it how, or the settings of the
/// options.
class Engine {
public:
    Engine(const Options& options, const Scene& scene)
        : simulator_(settingsOf(options, scene)), plans_(options.planned()) {
        simulator_.bodies().upload(scene.spheres);
        if (!plans_) return;
        planner_.emplace(simulator_, scene, options.tolerance.value_or(toleranceOf(scene.name)));
        if (options.tolerance) requireMet(planner_->plan());
    }

    PhysicsSimulator& simulator() { return simulator_; }

    /// Moves the scene by a frame; counts what there was to count.
    StepStats frame(Summary& summary) {
        StepStats whole;
        const auto step = [&] { addTo(whole, simulator_.step(), summary); };
        if (!planner_)
            step();
        else if (const std::optional<std::string> change = planner_->frame(step))
            std::cerr << *change << std::endl;
        ++summary.steps;
        summary.millisecondsPerStep +=
            (whole.frameTimeMs - summary.millisecondsPerStep) / summary.steps;
        return whole;
    }

    void report(Summary& summary) const {
        if (!planner_) {
            summary.plan = inShort(simulator_.settings());
            return;
        }
        summary.plan = inShort(planner_->plan());
        summary.readings = planner_->readings();
        summary.planShare =
            planner_->milliseconds() /
            (planner_->milliseconds() + summary.millisecondsPerStep * summary.steps);
    }

private:
    static SimulatorSettings settingsOf(const Options& options, const Scene& scene) {
        SimulatorSettings settings = settingsFor(scene, options.device);
        settings.response = responseMethod(options.response);
        settings.broadPhase = options.allPairs ? BroadPhaseMethod::naive : BroadPhaseMethod::grid;
        static_cast<ResponseKnobs&>(settings) = options.knobs;
        return settings;
    }

    static void addTo(StepStats& whole, StepStats step, Summary& summary) {
        summary.collisions += step.collisions;
        summary.overflows += step.overflow > 0;
        summary.rebuilds += step.gridRebuilt;
        summary.outside += step.outside;
        step.frameTimeMs += whole.frameTimeMs;
        addStages(step.stages, whole.stages);
        whole = std::move(step);
    }

    PhysicsSimulator simulator_;
    bool plans_;
    std::optional<Planner> planner_;
};

/// Steps until the frames are done or the user stops it; fills in what was counted. `link` leads to
/// a window, or is null.
inline void runSteps(Engine& engine, const Scene& scene, const Options& options, ViewerLink* link,
                     Summary& summary) {
    PhysicsSimulator& simulator = engine.simulator();
    OrderedFilm film(options, scene);
    Observation now(simulator, scene);
    std::optional<WindowFeed> feed;
    std::optional<Progress> progress;
    if (link) {
        feed.emplace(*link, options, scene);
        feed->show(now);
    } else {
        progress.emplace(summary.stepsAsked);
    }
    while (summary.steps < summary.stepsAsked && !StopRequest::received() &&
           (!feed || feed->awaitTurn(now))) {
        simulator.timeStages(film.wantsTimes() || (feed && feed->wantsTimes()));
        const StepStats stats = engine.frame(summary);
        now.stepDone(stats);
        film.stepDone(now);
        if (feed) feed->stepDone(now);
        if (progress) progress->advance(stats.frameTimeMs);
    }
    progress.reset();
    if (feed) feed->finish();
    film.finish();
}

/// Simulates the scene of the options, shows and films it, and returns the summary. When a body
/// stops being finite, the last good state is saved before NotFiniteError goes on.
inline Summary runScene(const Options& options) {
    const Scene scene = sceneFor(options);
    Engine engine(options, scene);
    PhysicsSimulator& simulator = engine.simulator();

    Summary summary{.scene = scene.name, .device = options.device, .balls = scene.spheres.count()};
    summary.stepsAsked = options.frames;
    summary.dt = scene.dt;
    const StopRequest stop;
    try {
        const auto run = [&](ViewerLink* link) { runSteps(engine, scene, options, link, summary); };
        options.view ? runBesideWindow(options, scene, run) : run(nullptr);
    } catch (const NotFiniteError& error) {
        const std::string path =
            options.saveFile.empty() ? "last_good_state.csv" : options.saveFile;
        writeSpheres(path, simulator.bodies().download());
        throw NotFiniteError(std::string(error.what()) + " and saved to " + path);
    }
    if (options.endless) summary.stepsAsked = summary.steps;
    summary.interrupted = StopRequest::received();

    const Spheres final = simulator.bodies().download();
    if (!options.saveFile.empty()) writeSpheres(options.saveFile, final);
    engine.report(summary);
    summary.metrics = measure(final, scene.bounds, scene.gravity, scene.dt, scene.periodic);
    summary.hash = stateHash(final);
    summary.video = options.out;
    summary.picture = options.png;
    summary.save = options.saveFile;
    return summary;
}

}  // namespace ballpit
