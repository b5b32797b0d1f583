// Maps of a single contact: "tunnelling" (two balls, how fast and how far off centre), "overlap"
// (two balls that start inside each other) and "penalty" (how well a spring and a dashpot restore).
#pragma once

#include <numbers>

#include "11_stability/penalty.cuh"
#include "stability/scenes.h"
#include "stability/trial.cuh"
#include "truth/collisions.h"
#include "truth/penalty.h"

namespace ballpit::stability {

constexpr double angleTolerance = 5;  ///< degrees

inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// The relative velocity of the two bodies of a scene.
inline Vec3d relativeVelocity(const Spheres& s) {
    const Vec3 a = s.velocities[0], b = s.velocities[1];
    return {double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z};
}

/// How two balls part.
struct Meeting {
    bool hit;
    double turned;  ///< degrees
    double energy;  ///< after over before
};

inline Meeting meet(const TwoBodies& knobs, ResponseMethod method, Device device) {
    const Scene scene = makeTwoBodies(knobs);
    Trial trial(scene, settingsWith(scene, device, method));
    // Long enough for a soft contact, short enough to stay clear of the walls.
    const int steps = knobs.travel > 1 ? 4 : 12;
    for (int step = 0; step < steps; ++step) trial.step();
    const Spheres end = trial.state();
    const Vec3d before = relativeVelocity(scene.spheres), after = relativeVelocity(end);
    const double along = (before.x * after.x + before.y * after.y + before.z * after.z) /
                         (length(before) * length(after));
    return {length(end.velocities[1]) > 1e-6 * length(before),
            degrees(std::acos(std::clamp(along, -1.0, 1.0))),
            kineticEnergyOf(end) / kineticEnergyOf(scene.spheres)};
}

/// Over evenly spread phases of the step. The value is the rms error of the angle, in degrees, of
/// those that met.
inline Outcome tunnellingCell(double travel, double offset, ResponseMethod method, Device device) {
    constexpr int phases = 8;
    return outcomeOf([&]() -> Outcome {
        const double truth = degrees(truth::scatteringAngle(offset, 1, 1));
        double squares = 0, energy = 1;
        int hits = 0;
        for (int k = 0; k < phases; ++k) {
            const Meeting meeting = meet({.offset = static_cast<float>(offset),
                                          .travel = static_cast<float>(travel),
                                          .phase = (static_cast<float>(k) + 0.5f) / phases},
                                         method, device);
            energy = std::max(energy, meeting.energy);
            if (!meeting.hit) continue;
            ++hits;
            squares += (meeting.turned - truth) * (meeting.turned - truth);
        }
        const double error = hits > 0 ? std::sqrt(squares / hits) : notMeasured;
        if (energy > 1.1) return {Verdict::energy, error};
        if (hits < phases) return {Verdict::lost, error};
        return {error > angleTolerance ? Verdict::inaccurate : Verdict::ok, error};
    });
}

/// Two balls approach inside contact over sqrt(sigma^2 - b^2); whoever goes farther from look to
/// look can pass unseen (truth::impulseAppliedShare is the mean of that over b). `looks` a step.
inline Line unseenLine(double looks) {
    Line line{"some pass unseen: v h > sqrt(sigma^2 - b^2)", {}};
    for (int k = 0; k <= 100; ++k) {
        const double b = 0.01 * k;
        line.points.emplace_back(2 * looks * std::sqrt(1 - b * b), b);
    }
    return line;
}

inline Map tunnellingMap(const MapOptions& options) {
    Map map{"tunnelling",
            "How fast may two balls meet, and how far off centre?",
            "all of 8 phases hit, and the angle errs by 5 degrees rms at most",
            "rms error of the angle in degrees",
            {}};
    const Axis travel{"radii travelled in a step",
                      options.coarse ? std::vector<double>{0.05, 4}
                                     : std::vector<double>{0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1,
                                                           1.5, 2, 3, 5, 8}};
    const Axis offset{
        "impact parameter over diameter",
        options.coarse ? std::vector<double>{0, 0.7}
                       : std::vector<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97}};
    using enum ResponseMethod;
    for (const ResponseMethod method : {coloured, warm, smallSteps, penalty}) {
        const Device device = options.device;
        // Substeps and a list of near pairs: the bodies travel less from look to look.
        const double looks = movesInSubsteps(method) ? (method == penalty ? 16 : 6) : 1;
        Panel panel{method == coloured ? "all with rounds (coloured)" : name(method),
                    travel,
                    offset,
                    [=](double s, double b) { return tunnellingCell(s, b, method, device); },
                    {}};
        panel.lines.push_back(unseenLine(looks));
        if (method != penalty)  // a soft contact turns its normal while it lasts
            panel.lines.push_back(lineOver(
                travel, "late normal: 2 b v h / (sqrt(3) sigma^2) = 5 degrees", [=](double s) {
                    return angleTolerance * std::numbers::pi / 180 * std::sqrt(3.0) * looks / s;
                }));
        map.panels.push_back(panel);
    }
    return map;
}

/// J: a push that is to separate two balls may give them this much.
constexpr double overlapEnergy = 0.5e-2 * gravityOfEarth * ballRadius * 2;

/// Two balls at rest, `overlap` radii inside each other, for a second: the value is the largest
/// kinetic energy over what is allowed.
inline Outcome overlapCell(double overlap, const SimulatorSettings& settings, const Scene& scene) {
    return outcomeOf([&]() -> Outcome {
        Trial trial(scene, settings);
        double largest = 0;
        for (int step = 0; step < 60; ++step) {
            trial.step();
            largest = std::max(largest, kineticEnergyOf(trial.state()) / overlapEnergy);
        }
        const double left = overlapOf(trial.state(), scene.bounds).max;
        if (largest > 1) return {Verdict::energy, largest};
        return {left > 0.1 * overlap ? Verdict::inaccurate : Verdict::ok, largest};
    });
}

inline Scene overlappingPair(double overlap, float restitution) {
    Scene scene = makeTwoBodies({.restitution = restitution});
    scene.name = "overlap";
    scene.spheres.positions[0] = {static_cast<float>(-2 * ballRadius + overlap * ballRadius), 0, 0};
    scene.spheres.velocities[0] = {};
    return scene;
}

/// s: a penalty contact of the engine, with so many substeps in a step of 1/60 s.
inline double contactTimeWith(double substeps) { return substepsOfContact / 60 / substeps; }

inline Map overlapMap(const MapOptions& options) {
    Map map{"overlap",
            "What do two balls do that start inside each other?",
            "they part, to a tenth of the overlap, with at most m g r / 200 a ball",
            "kinetic energy over what is allowed",
            {}};
    const Axis overlap{"overlap at the start, radii",
                       options.coarse
                           ? std::vector<double>{0.02, 1}
                           : std::vector<double>{0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 1.8}};
    const Axis share{"share taken away a pass",
                     options.coarse ? std::vector<double>{0.2, 1}
                                    : std::vector<double>{0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1}};
    const Axis substeps{"substeps of a step", options.coarse
                                                  ? std::vector<double>{1, 16}
                                                  : std::vector<double>{1, 2, 4, 8, 16, 32, 64}};
    using enum ResponseMethod;
    constexpr double e = 0.5, mass = 1;
    for (const ResponseMethod method : {jacobi, coloured, warm, smallSteps, penalty}) {
        const Device device = options.device;
        const bool hasShare = !movesInSubsteps(method);
        Panel panel{name(method),
                    overlap,
                    hasShare ? share : substeps,
                    [=](double depth, double knob) {
                        const Scene scene = overlappingPair(depth, static_cast<float>(e));
                        SimulatorSettings settings = settingsWith(scene, device, method);
                        if (hasShare)
                            settings.positionShare = static_cast<float>(knob);
                        else
                            settings.substeps = static_cast<int>(knob);
                        return overlapCell(depth, settings, scene);
                    },
                    {}};
        if (hasShare)  // both move with half of v: m v^2 / 4 is allowed
            panel.lines.push_back(lineOver(
                overlap, "if the push became velocity (Baumgarte): v = share * overlap / dt",
                [](double d) {
                    return 2 * std::sqrt(overlapEnergy / mass) / 60 / (d * ballRadius);
                }));
        if (method == penalty)
            panel.lines.push_back(lineOver(overlap, "the spring's energy: k d^2 / 2", [](double d) {
                const double logarithm = std::log(e), depth = d * ballRadius;
                const double stiffness =
                    (std::numbers::pi * std::numbers::pi + logarithm * logarithm) * mass / 2;
                // k = stiffness / t_c^2; t_c at which k d^2 / 2 is what is allowed
                const double time = depth * std::sqrt(stiffness / (2 * overlapEnergy));
                return contactTimeWith(1) / time;
            }));
        map.panels.push_back(panel);
    }
    return map;
}

/// Two balls on a line under the engine's own pressure(): how fast they leave each other, having
/// met with 1 m/s; `phase` of a step deep when the first pressure acts.
inline double penaltyRestitution(double stepOverContact, float restitution, double phase) {
    const PenaltySettings settings{1e-3f, static_cast<float>(1e-3 / stepOverContact), {}};
    float separation = -1.0f, penetration = static_cast<float>(phase) * settings.h;
    for (int step = 0; step < 100000 && penetration > 0.0f; ++step) {
        separation += pressure(penetration, separation, restitution, settings);
        penetration -= settings.h * separation;
    }
    return separation;
}

inline Outcome penaltyCell(double stepOverContact, double restitution) {
    constexpr int phases = 16;
    double error = 0, largest = 0;
    for (int k = 0; k < phases; ++k) {
        const double found = penaltyRestitution(stepOverContact, static_cast<float>(restitution),
                                                (k + 0.5) / phases);
        if (!std::isfinite(found)) return {Verdict::notFinite, notMeasured};
        error += std::abs(found - restitution) / phases;
        largest = std::max(largest, found);
    }
    if (largest > 1.02) return {Verdict::energy, error};
    return {error > 0.02 ? Verdict::inaccurate : Verdict::ok, error};
}

inline Map penaltyMap(const MapOptions& options) {
    Map map{"penalty",
            "How many steps must a contact of spring and dashpot last?",
            "the restitution errs by 0.02 at most, mean over 16 phases",
            "error of e",
            {}};
    const Axis step{"step over contact time",
                    options.coarse ? std::vector<double>{0.05, 0.5}
                                   : std::vector<double>{0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15,
                                                         0.2, 0.3, 0.4, 0.5, 0.6, 0.8}};
    const Axis e{"restitution", options.coarse ? std::vector<double>{0.5, 1}
                                               : std::vector<double>{0.02, 0.05, 0.1, 0.2, 0.3, 0.4,
                                                                     0.5, 0.6, 0.7, 0.8, 0.9, 1}};
    Panel panel{"penalty", step, e, penaltyCell, {}};
    panel.lines.push_back(lineAt(1.0 / substepsOfContact, e, "the engine's: 20 steps a contact"));
    Line unstable{"stability limit: h = 2 / omega0", {}};
    for (double r = 0.02; r <= 1.0; r += 0.02) {
        // omega0 t_c = pi / sqrt(1 - z^2) (truth::contactTime)
        const double z = truth::dampingRatio(r);
        unstable.points.emplace_back(2 * std::sqrt(1 - z * z) / std::numbers::pi, r);
    }
    panel.lines.push_back(unstable);
    map.panels.push_back(panel);
    return map;
}

}  // namespace ballpit::stability
