// The chapter's scenes, each under two methods: one that fails there, and one that holds.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "10_full_system/physics_simulator.cuh"
#include "common/metrics.h"
#include "common/options.h"
#include "common/words.h"
#include "stability/scenes.h"

namespace ballpit {

/// A method, and how often it passes over the contacts and moves the bodies in a step; 0: as often
/// as it does by itself.
struct Fighter {
    ResponseMethod method;
    int passes = 0, substeps = 0;
};

/// One side of a duel: a scene under one method.
class Side {
public:
    /// After so many steps.
    Side(const Scene& scene, const Fighter& fighter, Device device, int steps = 0)
        : scene_(scene), method_(fighter.method), simulator_(settings(fighter, device)) {
        simulator_.bodies().upload(scene.spheres);
        for (int k = 0; k < steps; ++k) step();
    }

    /// One step; none if a ball is no longer a number: then all stays as it was before that.
    void step() {
        if (isLost_) return;
        try {
            simulator_.step();
        } catch (const NotFiniteError&) {
            isLost_ = true;
        }
    }

    /// Does a step's work, and keeps the state. For measuring time.
    void rehearse() { simulator_.rehearseStep(); }

    Spheres balls() { return simulator_.bodies().download(); }
    const Scene& scene() const { return scene_; }
    ResponseMethod method() const { return method_; }
    std::string methodName() const { return name(method_); }
    const ResponseKnobs& knobs() const { return simulator_.settings(); }

    /// Pairs on the list of the last step, whether they touch or are within reach.
    std::size_t listedPairs() { return simulator_.lastPairs().size(); }
    /// Kinetic energy over that at the start.
    double energyShare() { return energyOf(balls()) / energyOf(scene_.spheres); }
    /// The deepest, in radii.
    double overlap() { return metricsOf(balls()).largestPenetration / stability::ballRadius; }

    /// m/s.
    double topSpeed() {
        float speed = 0;
        for (const Vec3 v : balls().velocities) speed = std::max(speed, length(v));
        return double(speed);
    }

private:
    SimulatorSettings settings(const Fighter& fighter, Device device) const {
        SimulatorSettings settings = settingsFor(scene_, device);
        settings.response = fighter.method;
        if (fighter.passes) settings.iterations = fighter.passes;
        if (fighter.substeps) settings.substeps = fighter.substeps;
        return settings;
    }

    Metrics metricsOf(const Spheres& balls) const {
        return measure(balls, scene_.bounds, scene_.gravity, scene_.dt);
    }
    double energyOf(const Spheres& balls) const { return metricsOf(balls).kineticEnergy; }

    Scene scene_;
    ResponseMethod method_;
    PhysicsSimulator simulator_;
    bool isLost_ = false;
};

// What a duel is judged by.

inline std::string fourDigits(double value) { return withDigits(value, 4); }
inline std::string energyKept(Side& side) { return fourDigits(side.energyShare()); }
inline std::string deepestOverlap(Side& side) { return fourDigits(side.overlap()); }
inline std::string ballsStruck(Side& side) {
    const std::vector<Vec3> speeds = side.balls().velocities;
    return std::to_string(std::count_if(speeds.begin() + 1, speeds.end(),
                                        [](Vec3 v) { return lengthSquared(v) > 0.0f; }));
}
inline std::string fastestBall(Side& side) { return fourDigits(side.topSpeed()); }
inline std::string speeds(Side& side) {
    std::string text;
    for (const Vec3 v : side.balls().velocities) {
        if (!text.empty()) text += ' ';
        text += fourDigits(std::abs(v.x) < 1e-3f ? 0.0 : double(v.x));
    }
    return text;
}

/// One scene, two methods.
struct Duel {
    std::string scene;
    Scene (*make)(std::uint64_t seed);
    int steps;
    Fighter fails, holds;
    const char* measure;
    std::string (*value)(Side& side);
    int framesAStep = 1;  ///< of a film: how long it holds each step
    Bounds view{};        ///< of a film: what it shows, m; all of the world if empty

    /// What a figure follows from step to step: the overlap with gravity, else the energy.
    double track(Side& side) const {
        return side.scene().gravity.y != 0 ? side.overlap() : side.energyShare();
    }
};

inline std::vector<Duel> allDuels() {
    using namespace stability;
    using enum ResponseMethod;
    using Seed = std::uint64_t;
    const char *energy = "energy / at start", *overlap = "deepest overlap / r";
    return {{"pocket",
             [](Seed) { return makePocket(1); },
             1,
             {jacobi},
             {coloured},
             energy,
             energyKept,
             1,
             {{-1.5f, -1, -1.5f}, {1.5f, 2, 1.5f}}},
            {"gas",
             [](Seed seed) { return makeGasOf({.count = 216, .volumeShare = 0.4f, .seed = seed}); },
             80,
             {jacobi},
             {coloured},
             energy,
             energyKept},
            {"column",
             [](Seed) { return makeColumn(10, 0); },
             240,
             {coloured},
             {warm},
             overlap,
             deepestOverlap},
            {"pile",
             [](Seed seed) { return makeDeepPile(400, seed); },
             240,
             {massSplit},
             {smallSteps},
             overlap,
             deepestOverlap},
            {"bullet",
             [](Seed) { return makeBullet(5, 8); },
             6,
             {coloured},
             {smallSteps, 0, 64},
             "balls struck",
             ballsStruck,
             50,
             {{-5, -2, -2}, {12, 7, 7}}},
            {"crowd",
             [](Seed seed) { return makePile(500, seed); },
             10,
             {smallSteps},
             {warm},
             "fastest ball, m/s",
             fastestBall},
            {"cradle",
             [](Seed) { return makeCradle(5, false); },
             60,
             {warm, 200},
             {coloured},
             "speeds, m/s",
             speeds}};
}

/// "pocket, gas, ...".
inline std::string duelNames() {
    return commaSeparated(allDuels(), [](const Duel& duel) { return duel.scene; });
}

/// What --scene can be.
inline std::string sceneChoice() {
    return "all, methods (all methods in the same scenes), or one of " + duelNames();
}

/// The duels that --scene asks for. InputError for an unknown name.
inline std::vector<Duel> duelsNamed(const std::string& name) {
    std::vector<Duel> wanted;
    for (const Duel& duel : allDuels())
        if (name == "all" || name == duel.scene) wanted.push_back(duel);
    if (wanted.empty()) throw InputError("scene '" + name + "': " + sceneChoice());
    return wanted;
}

/// Both sides of a duel.
struct Match {
    Match(const Duel& duel, const Options& options)
        : scene(duel.make(options.seed)),
          sides{Side(scene, duel.fails, options.device), Side(scene, duel.holds, options.device)} {}

    void step() {
        for (Side& side : sides) side.step();
    }

    Scene scene;
    Side sides[2];
};

}  // namespace ballpit
