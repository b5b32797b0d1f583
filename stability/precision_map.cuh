// Map "precision": how far from the origin, and with how small a step, does a ball still fall?
#pragma once

#include <bit>

#include "stability/scenes.h"
#include "stability/trial.cuh"
#include "stability/worlds.h"
#include "truth/motion.h"

namespace ballpit::stability {

constexpr double fallTolerance = 0.01;

/// m: from a float of this size to the next.
inline double spacingOfFloats(double x) {
    const auto value = static_cast<float>(x);
    return double(std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) + 1)) - value;
}

/// A ball falls along x for a second, from rest, `distance` m away from the origin. The value is
/// the largest error on the way, over the whole way: at the end alone, roundings may happen to
/// cancel.
inline Outcome precisionCell(double distance, double dt, ResponseMethod method, Device device) {
    return outcomeOf([&]() -> Outcome {
        const auto x = static_cast<float>(distance);
        Scene scene = emptyWorld("precision", {{x - 20, -4, -4}, {x + 20, 4, 4}});
        scene.cellSize = 4;
        scene.dt = static_cast<float>(dt);
        scene.gravity = {-gravityOfEarth, 0, 0};
        addBall(scene, {x, 0, 0});
        Trial trial(scene, settingsWith(scene, device, method));
        const int substeps = movesInSubsteps(method) ? *trial.settings().substeps : 1;
        const auto exactWay = [&](int step) {
            return truth::semiImplicitFall({0, 0}, gravityOfEarth, scene.dt / double(substeps), 1,
                                           step * substeps)
                .height;
        };
        const int steps = std::max(1, static_cast<int>(std::lround(1 / dt)));
        double error = 0;
        for (int step = 1; step <= steps; ++step) {
            trial.step();
            const Vec3 place = trial.bodies().positions.download()[0];
            error = std::max(error, std::abs(double(place.x) - x - exactWay(step)));
        }
        error /= std::abs(exactWay(steps));
        return {error > fallTolerance ? Verdict::inaccurate : Verdict::ok, error};
    });
}

inline Map precisionMap(const MapOptions& options) {
    Map map{"precision",
            "How far away, and how finely, can a ball fall in floats?",
            "in a second it is never wrong by more than 1 % of its way",
            "largest error over the way",
            {}};
    const Axis distance{"distance from the origin in m",
                        options.coarse ? std::vector<double>{1, 1e6}
                                       : std::vector<double>{1, 10, 100, 1e3, 1e4, 1e5, 1e6}};
    const Axis dt{"time step in s", options.coarse
                                        ? std::vector<double>{0.001, 0.02}
                                        : std::vector<double>{1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3,
                                                              0.01, 0.02, 0.05, 0.1}};
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
            lineOver(distance, "exact from the first step: g h^2 > 4 spacings of floats at x",
                     [=](double x) {
                         return substeps * std::sqrt(4 * spacingOfFloats(x) / gravityOfEarth);
                     }));
        panel.lines.push_back(lineOver(
            distance, "stuck for a tenth of a second: g t h < half a spacing", [=](double x) {
                const double stuck = std::sqrt(fallTolerance);  // s: g t^2 / 2 is lost
                return substeps * spacingOfFloats(x) / 2 / (gravityOfEarth * stuck);
            }));
        map.panels.push_back(panel);
    }
    return map;
}

}  // namespace ballpit::stability
