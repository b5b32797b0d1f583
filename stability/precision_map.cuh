// Map "precision": how far from the origin, and with how small a step, does a ball still fall?
#pragma once

#include <bit>

#include "stability/scenes.h"
#include "stability/trial.cuh"
#include "stability/worlds.h"
#include "truth/motion.h"

namespace ballpit::stability {

/// m: from a float of this size to the next.
inline double spacingOfFloats(double x) {
    const auto value = static_cast<float>(x);
    return double(std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) + 1)) - value;
}

/// A ball falls along x for a second, from rest, `distance` m away from the origin; the value is
/// the relative error of the way it falls.
inline Outcome precisionCell(double distance, double dt, ResponseMethod method, Device device) {
    return outcomeOf([&]() -> Outcome {
        const auto x = static_cast<float>(distance);
        Scene scene = emptyWorld("precision", {{x - 20, -4, -4}, {x + 20, 4, 4}});
        scene.cellSize = 4;
        scene.dt = static_cast<float>(dt);
        scene.gravity = {-gravityOfEarth, 0, 0};
        addBall(scene, {x, 0, 0});
        Trial trial(scene, settingsWith(scene, device, method));
        const int steps = std::max(1, static_cast<int>(std::lround(1 / dt)));
        for (int step = 0; step < steps; ++step) trial.step();
        const Spheres end = trial.state();
        const double substeps = movesInSubsteps(method) ? *trial.settings().substeps : 1;
        const double exact = truth::semiImplicitFall({0, 0}, gravityOfEarth, scene.dt / substeps, 1,
                                                     static_cast<int>(steps * substeps))
                                 .height;
        const double error =
            std::abs((double(end.positions[0].x) - scene.spheres.positions[0].x) / exact - 1);
        if (lossesOf(end, scene.bounds).lost > 0) return {Verdict::lost, error};
        return {error > 0.01 ? Verdict::inaccurate : Verdict::ok, error};
    });
}

inline Map precisionMap(const MapOptions& options) {
    Map map{"precision",
            "How far away, and how finely, can a ball fall in floats?",
            "its fall of a second errs by 1 % at most",
            "relative error of the way",
            {}};
    const Axis distance{"distance from the origin in m",
                        options.coarse ? std::vector<double>{1, 1e6}
                                       : std::vector<double>{1, 10, 100, 1e3, 1e4, 1e5, 1e6}};
    const Axis dt{"time step in s",
                  options.coarse ? std::vector<double>{0.001, 0.02} : ratioSteps(1e-4, 0.1, 10)};
    using enum ResponseMethod;
    for (const ResponseMethod method : {coloured, smallSteps}) {
        const Device device = options.device;
        const double substeps = method == smallSteps ? 6 : 1;
        Panel panel{method == coloured ? "one motion a step (coloured)" : "small-steps, 6 substeps",
                    distance,
                    dt,
                    [=](double x, double step) { return precisionCell(x, step, method, device); },
                    {}};
        panel.lines.push_back(
            lineOver(distance, "g h^2 = 4 spacings of floats at x", [=](double x) {
                return substeps * std::sqrt(4 * spacingOfFloats(x) / gravityOfEarth);
            }));
        map.panels.push_back(panel);
    }
    return map;
}

}  // namespace ballpit::stability
