// Maps "column" and "heavy": what stands on what without being squashed. Passes against height, and
// against the ratio of masses.
#pragma once

#include "stability/scenes.h"
#include "stability/trial.cuh"
#include "truth/columns.h"

namespace ballpit::stability {

/// Of r: what a ball may overlap.
constexpr double restTolerance = 0.1;
constexpr double frames = 60;  ///< steps a second

/// The deepest overlap in the last second of `seconds`, in radii. Gravity's energy at the start is
/// all there is: a ball that rises higher than it can has got it from nowhere.
inline Outcome restingCell(const Scene& scene, ResponseMethod method, int passes, double seconds,
                           Device device) {
    return outcomeOf([&]() -> Outcome {
        Trial trial(scene, settingsWith(scene, device, method, passes));
        const int steps = static_cast<int>(seconds * frames);
        const float top = scene.spheres.positions.back().y;
        double deepest = 0;
        for (int step = 1; step <= steps; ++step) {
            trial.step();
            if (step <= steps - static_cast<int>(frames)) continue;
            const Spheres now = trial.state();
            deepest = std::max(deepest, overlapOf(now, scene.bounds).max);
            if (hasFallenThrough(now)) return {Verdict::lost, deepest};
            if (now.positions.back().y > top + ballRadius) return {Verdict::energy, deepest};
        }
        return {deepest <= restTolerance ? Verdict::ok : Verdict::inaccurate, deepest};
    });
}

/// Do the walls push this method's bodies only once in a step?
inline bool feelsWallsOnce(ResponseMethod method) {
    return !movesInSubsteps(method) && method != ResponseMethod::warm;
}

constexpr double allowedOverlap = restTolerance * ballRadius;  ///< m

/// n (n - 1) g dt^2 = allowed (truth::columnOverlapFloorOnce); heavy on light has n = 1 + R, since
/// what counts is how many times the lowest ball's mass rests on the floor.
inline double tallestOnFloorFeltOnce() {
    return 0.5 + std::sqrt(0.25 + allowedOverlap * frames * frames / gravityOfEarth);
}

inline Map columnMap(const MapOptions& options) {
    Map map{"column",
            "How tall a column of equal balls stands?",
            "no overlap is deeper than 0.1 r in the last of 3 s",
            "deepest overlap / r",
            {}};
    const Axis passes{"passes a second", options.coarse
                                             ? std::vector<double>{120, 1920}
                                             : std::vector<double>{60, 120, 240, 480, 960, 1920}};
    const Axis balls{"balls", options.coarse
                                  ? std::vector<double>{2, 10}
                                  : std::vector<double>{2, 3, 4, 5, 7, 10, 14, 20, 28, 40}};
    const double seconds = options.coarse ? 2 : 3;
    for (const ResponseMethod method : allMethods()) {
        const Device device = options.device;
        Panel panel{name(method),
                    passes,
                    balls,
                    [=](double rate, double count) {
                        return restingCell(makeColumn(static_cast<int>(count), dullest(method)),
                                           method, static_cast<int>(rate / frames), seconds,
                                           device);
                    },
                    {}};
        panel.lines.push_back(
            lineOver(passes, "nothing remembered: C n^3 g tau^2 = 0.1 r", [](double rate) {
                return truth::tallestColumn(truth::columnShuffled, allowedOverlap, gravityOfEarth,
                                            1 / rate);
            }));
        if (feelsWallsOnce(method))
            panel.lines.push_back(lineOver(passes, "floor felt once a step: n (n-1) g dt^2 = 0.1 r",
                                           [](double) { return tallestOnFloorFeltOnce(); }));
        map.panels.push_back(panel);
    }
    return map;
}

inline Map heavyMap(const MapOptions& options) {
    Map map{"heavy",
            "How heavy a ball can lie on a light one?",
            "no overlap is deeper than 0.1 r in the last of 2 s",
            "deepest overlap / r",
            {}};
    const Axis passes{"passes a second",
                      options.coarse ? std::vector<double>{120, 1920}
                                     : std::vector<double>{60, 120, 240, 480, 960, 1920, 3840}};
    const Axis ratio{"mass of the upper over the lower",
                     options.coarse
                         ? std::vector<double>{1, 30}
                         : std::vector<double>{1, 2, 3, 5, 10, 20, 30, 50, 100, 300, 1000}};
    for (const ResponseMethod method : allMethods()) {
        const Device device = options.device;
        Panel panel{name(method),
                    passes,
                    ratio,
                    [=](double rate, double R) {
                        return restingCell(makeHeavyOnLight(static_cast<float>(R), dullest(method)),
                                           method, static_cast<int>(rate / frames), 2, device);
                    },
                    {}};
        if (feelsWallsOnce(method))
            panel.lines.push_back(lineOver(passes, "floor felt once a step: R (R+1) g dt^2 = 0.1 r",
                                           [](double) { return tallestOnFloorFeltOnce() - 1; }));
        else
            panel.lines.push_back(
                lineOver(passes, "from nothing, a step's passes shrink the error to a tenth",
                         [](double rate) {
                             // rate^passes = 1/10, rate = R / (1 + R): truth::heavyOnLightRate
                             const double share = std::pow(0.1, frames / rate);
                             return share / (1 - share);
                         }));
        map.panels.push_back(panel);
    }
    return map;
}

}  // namespace ballpit::stability
