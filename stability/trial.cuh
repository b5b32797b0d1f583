// Runs a scene with a method and says how it ended. What all maps are made of.
#pragma once

#include <cmath>
#include <limits>

#include "10_full_system/physics_simulator.cuh"
#include "stability/map.h"
#include "stability/metrics.h"

namespace ballpit::stability {

/// All methods, in the order of the panels.
inline std::vector<ResponseMethod> allMethods() {
    using enum ResponseMethod;
    return {racy, atomic, jacobi, massSplit, coloured, warm, smallSteps, penalty};
}

/// Do the passes of this method move the bodies, each a share of the step?
inline bool movesInSubsteps(ResponseMethod method) {
    return method == ResponseMethod::smallSteps || method == ResponseMethod::penalty;
}

/// The smallest restitution that the method can give: 0, or for springs and dashpots a little more.
inline float dullest(ResponseMethod method) {
    return method == ResponseMethod::penalty ? 0.02f : 0.0f;
}

/// A method with so many passes over the contacts a step; 0: as many as it has by itself.
inline SimulatorSettings settingsWith(const Scene& scene, Device device, ResponseMethod method,
                                      int passes = 0) {
    SimulatorSettings settings = settingsFor(scene, device);
    settings.response = method;
    if (passes > 0 && movesInSubsteps(method))
        settings.substeps = passes;
    else if (passes > 0)
        settings.iterations = passes;
    // Twelve pairs a ball are the most for balls that do not overlap; some methods list near ones.
    settings.pairCapacity = 16 * scene.spheres.count() + 64;
    settings.growPairs = false;
    return settings;
}

/// How many pairs a step visited: those it listed (in the longest of its rounds), times its passes
/// over them. A cost without a machine; finding the pairs is not in it.
inline double visitsOf(const StepStats& stats, const SimulatorSettings& settings) {
    return double(*settings.iterations) * *settings.substeps * stats.listed;
}

/// A simulator with a scene in it. On a CPU the racy method plays its race on one thread, the same
/// each time: two threads would hardly ever meet.
class Trial : public PhysicsSimulator {
public:
    Trial(const Scene& scene, const SimulatorSettings& settings) : PhysicsSimulator(settings) {
        if (settings.response == ResponseMethod::racy && settings.device == Device::cpu)
            response_ = std::make_unique<RacyResponse>(Device::cpu, true);
        bodies().upload(scene.spheres);
    }
    Spheres state() { return bodies().download(); }
};

constexpr double notMeasured = std::numeric_limits<double>::quiet_NaN();

/// What `run` returns, or the way in which it broke off.
template <class Run>
Outcome outcomeOf(Run run) {
    try {
        return run();
    } catch (const InputError&) {
        throw;  // a map that asks for what a method does not have
    } catch (const NotFiniteError&) {
        return {Verdict::notFinite, notMeasured};
    } catch (const std::runtime_error&) {
        return {Verdict::overflow, notMeasured};
    }
}

/// J, of state and reference alike: in double precision, in body order.
inline double kineticEnergyOf(const Spheres& spheres) {
    return 1.5 * temperatureOf(spheres) * static_cast<double>(spheres.count());
}

}  // namespace ballpit::stability
