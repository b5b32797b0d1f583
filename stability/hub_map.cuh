// Map "hub": how many contacts at once can a ball take? One step, one pass.
#pragma once

#include "stability/scenes.h"
#include "stability/trial.cuh"
#include "truth/collisions.h"

namespace ballpit::stability {

constexpr double hubCosine = 0.7;

/// The value is E' / E. Settings that are left empty are the method's own, but for one pass.
inline Outcome hubCell(const Hub& hub, ResponseMethod method, double relaxation, Device device) {
    return outcomeOf([&]() -> Outcome {
        const Scene scene = makeHub(hub);
        SimulatorSettings settings = settingsWith(scene, device, method, 1);
        if (relaxation > 0) settings.relaxation = static_cast<float>(relaxation);
        Trial trial(scene, settings);
        trial.step();
        const Spheres end = trial.state();
        const double energy = kineticEnergyOf(end) / kineticEnergyOf(scene.spheres);
        if (energy > 1.001) return {Verdict::energy, energy};
        const bool keepsMomentum = momentumError(scene.spheres, end) < 1e-3;
        return {keepsMomentum ? Verdict::ok : Verdict::inaccurate, energy};
    });
}

/// (1 + e)(1 + B (S - 1)) = 2 with S = k c^2, B = 1/2: truth::plainSumKeepsEnergy. Solved for 1 +
/// e.
inline double largestBounce(double spokes) {
    return 2 / (1 + 0.5 * (spokes * hubCosine * hubCosine - 1));
}

inline Map hubMap(const MapOptions& options) {
    Map map{"hub",
            "How many balls at once may a ball run into?",
            "energy does not grow in one pass, and momentum stays to 0.001 sqrt(2 E M)",
            "E' / E",
            {}};
    const Axis spokes{"contacts at once",
                      options.coarse ? std::vector<double>{1, 6}
                                     : std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
    const Axis e{"restitution", options.coarse ? std::vector<double>{0.5, 1}
                                               : std::vector<double>{0.02, 0.1, 0.2, 0.3, 0.4, 0.5,
                                                                     0.6, 0.7, 0.8, 0.9, 1}};
    const Axis relaxation{
        "relaxation at e = 1",
        options.coarse ? std::vector<double>{0.2, 1}
                       : std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1, 1.2, 1.5}};
    using enum ResponseMethod;
    const Device device = options.device;
    for (const ResponseMethod method : allMethods()) {
        if (method == penalty) continue;  // its contacts last longer than a step
        Panel panel{name(method),
                    spokes,
                    e,
                    [=](double k, double restitution) {
                        return hubCell({.spokes = static_cast<int>(k),
                                        .cosine = static_cast<float>(hubCosine),
                                        .restitution = static_cast<float>(restitution)},
                                       method, 0, device);
                    },
                    {}};
        if (method == jacobi || method == atomic)
            panel.lines.push_back(lineOver(spokes,
                                           "plain sum keeps its energy: (1+e)(1+B(S-1)) = 2",
                                           [](double k) { return largestBounce(k) - 1; }));
        map.panels.push_back(panel);
    }
    Panel relaxed{"jacobi, relaxed",
                  spokes,
                  relaxation,
                  [=](double k, double share) {
                      return hubCell(
                          {.spokes = static_cast<int>(k), .cosine = static_cast<float>(hubCosine)},
                          jacobi, share, device);
                  },
                  {}};
    relaxed.lines.push_back(lineOver(spokes, "plain sum keeps its energy: (1+e)(1+B(S-1)) = 2",
                                     [](double k) { return largestBounce(k) / 2; }));
    map.panels.push_back(relaxed);
    return map;
}

}  // namespace ballpit::stability
