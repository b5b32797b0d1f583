// Map "gas": does a gas keep its energy, or cool as it should? Volume share against step.
#pragma once

#include <numbers>

#include "stability/gas_truth.h"
#include "stability/trial.cuh"
#include "truth/kinetic_theory.h"

namespace ballpit::stability {

constexpr double gasTolerance = 0.1;

/// The value is E / E_true - 1 at the end. A gas that gains more than half on the way has failed,
/// whatever comes after.
inline Outcome gasCell(const Gas& gas, double collisions, ResponseMethod method, Device device) {
    return outcomeOf([&]() -> Outcome {
        const Scene scene = makeGasOf(gas);
        Trial trial(scene, settingsWith(scene, device, method));
        const double seconds = gasSeconds(gas, collisions), start = kineticEnergyOf(scene.spheres);
        const long steps = std::lround(std::ceil(seconds / scene.dt));
        const long between = std::max(1L, steps / 200);
        for (long step = 1; step <= steps; ++step) {
            trial.step();
            if (step % between != 0) continue;
            const double energy = kineticEnergyOf(trial.state());
            if (energy > 1.5 * start) return {Verdict::energy, energy / start - 1};
        }
        const Spheres end = trial.state();
        const double energy = kineticEnergyOf(end);
        const double expected = gas.restitution < 1 ? trueEnergy(scene, seconds) : start;
        const double error = energy / expected - 1;
        if (lossesOf(end, scene.bounds).lost > 0) return {Verdict::lost, error};
        if (energy > (1 + gasTolerance) * start) return {Verdict::energy, error};
        return {std::abs(error) > gasTolerance ? Verdict::inaccurate : Verdict::ok, error};
    });
}

/// Where double contacts alone should add a tenth. A ball at one contact has a second one in the
/// same step with the chance rate * dt. The plain sum of two impulses changes the energy of a hub
/// on two spokes by S^2 - S (truth/collisions.h: e = 1, B = 1/2); with c^2 uniform in 0..1, <S^2 -
/// S> = 1/6. So n collisions a ball gain n / 2 * rate * dt / 6.
inline double travelWhereDoubleContactsGain(double volumeShare, double collisions) {
    const double rate = truth::enskogRate(volumeShare * 6 / std::numbers::pi, 2 * ballRadius, 1, 1);
    const double dt = gasTolerance * 12 / (collisions * rate);
    return gasSpeed * dt / ballRadius;
}

inline Map gasMap(const MapOptions& options) {
    const double collisions = options.coarse ? 30 : 100;
    const int count = options.coarse ? 125 : 343;
    Map map{"gas",
            "Does a gas of hard spheres keep its energy (e = 1), or cool as it should (0.9)?",
            "the energy is within 10 % of the event-driven simulator's",
            "E / E_true - 1",
            {}};
    const Axis share{"volume share of the balls",
                     options.coarse ? std::vector{0.05, 0.2, 0.4}
                                    : std::vector{0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.48}};
    const Axis travel{
        "radii travelled in a step (rms)",
        options.coarse ? std::vector{0.1, 0.4} : std::vector{0.02, 0.05, 0.1, 0.2, 0.4, 0.8}};
    for (const float e : {1.0f, 0.9f})
        for (const ResponseMethod method : allMethods()) {
            const Device device = options.device;
            Panel panel{name(method) + (e < 1 ? ", e = 0.9" : ", e = 1"),
                        share,
                        travel,
                        [=](double phi, double s) {
                            return gasCell({.count = count,
                                            .volumeShare = static_cast<float>(phi),
                                            .travel = static_cast<float>(s),
                                            .restitution = e},
                                           collisions, method, device);
                        },
                        {}};
            const bool sums = method == ResponseMethod::jacobi || method == ResponseMethod::atomic;
            if (sums && e == 1)
                panel.lines.push_back(lineOver(
                    share, "double contacts gain 10 % (estimate)",
                    [=](double phi) { return travelWhereDoubleContactsGain(phi, collisions); }));
            map.panels.push_back(panel);
        }
    return map;
}

}  // namespace ballpit::stability
