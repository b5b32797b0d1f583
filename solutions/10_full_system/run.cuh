// Chapter 10: a run from scene to summary.
#pragma once

#include "10_full_system/physics_simulator.cuh"
#include "common/csv.h"
#include "common/film.h"
#include "common/progress.h"
#include "common/summary.h"

namespace ballpit {

/// Steps and films until the frames are done or the user stops it; fills in what was counted.
inline void runFrames(PhysicsSimulator& simulator, Film& film, Summary& summary) {
    RigidBodySystem& bodies = simulator.bodies();
    const std::vector<float> radii = bodies.radii.download();
    StopRequest stop;
    Progress progress(summary.stepsAsked);
    double milliseconds = 0.0;
    while (summary.steps < summary.stepsAsked && !StopRequest::received()) {
        const StepStats stats = simulator.step();
        if (film.isRolling()) film.capture(bodies.positions.download(), radii, bodies.colors);
        progress.advance(stats.frameTimeMs);
        milliseconds += stats.frameTimeMs;
        ++summary.steps;
        summary.collisions += stats.collisions;
        summary.overflows += stats.overflow > 0;
        summary.rebuilds += stats.gridRebuilt;
        summary.outside += stats.outside;
    }
    summary.millisecondsPerStep = milliseconds / std::max(1, summary.steps);
}

/// Simulates the scene of the options, films it, and returns the summary. When a body stops being
/// finite, the last good state is saved before NotFiniteError goes on.
inline Summary runScene(const Options& options) {
    const Scene scene = sceneFor(options);
    SimulatorSettings settings = settingsFor(scene, options.device);
    settings.response = responseMethod(options.response);
    static_cast<ResponseKnobs&>(settings) = options.knobs;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    Film film(options, scene.bounds);

    Summary summary{.scene = scene.name, .device = options.device, .balls = scene.spheres.count()};
    summary.stepsAsked = options.frames;
    summary.dt = scene.dt;
    try {
        runFrames(simulator, film, summary);
    } catch (const NotFiniteError& error) {
        const std::string path =
            options.saveFile.empty() ? "last_good_state.csv" : options.saveFile;
        writeSpheres(path, simulator.bodies().download());
        throw NotFiniteError(std::string(error.what()) + " and saved to " + path);
    }
    film.finish();

    const Spheres final = simulator.bodies().download();
    if (!options.saveFile.empty()) writeSpheres(options.saveFile, final);
    summary.metrics = measure(final, scene.bounds, scene.gravity, scene.dt);
    summary.hash = stateHash(final);
    summary.video = options.out;
    summary.picture = options.png;
    summary.save = options.saveFile;
    return summary;
}

}  // namespace ballpit
