// What a simulator is asked for, and whether that makes sense.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "common/device.h"
#include "common/error.h"
#include "common/response_method.h"
#include "common/scene.h"
#include "common/vec3.cuh"

namespace ballpit {

/// How touching pairs are found.
enum class BroadPhaseMethod {
    grid,  ///< bodies sorted into cells, 27 cells searched
    naive  ///< every body against every other: one cell for all, so nothing is sorted or moved
};

/// Larger than any world: the edge of the one cell of BroadPhaseMethod::naive, m.
constexpr float oneCellForAll = 1e9f;

/// The response's knobs (iterations, ...) come from common/response_method.h.
struct SimulatorSettings : ResponseKnobs {
    int objects = 500;
    Bounds bounds{{-20, 0, -20}, {20, 40, 20}};  ///< m
    bool periodic = false;                       ///< no walls: the world goes on where it ends
    float cellSize = 2.0f;                       ///< m, at least the largest diameter
    Device device = defaultDevice();
    float dt = 1.0f / 60.0f;     ///< s
    Vec3 gravity{0, -9.81f, 0};  ///< m/s^2
    float damping = 0.01f;       ///< 1/s
    ResponseMethod response = ResponseMethod::massSplit;
    BroadPhaseMethod broadPhase = BroadPhaseMethod::grid;
    std::size_t pairCapacity = 0;  ///< pairs to make room for at first; 0: four a body
    bool growPairs = true;         ///< on overflow: grow and redo, or fail
    bool timeStages = false;       ///< fills StepStats::stages, at the price of the CUDA graph

    std::size_t firstPairCapacity() const {
        return pairCapacity ? pairCapacity : 4 * static_cast<std::size_t>(objects);
    }
};

/// The settings that a scene's world asks for.
inline SimulatorSettings settingsFor(const Scene& scene, Device device) {
    SimulatorSettings settings;
    settings.objects = static_cast<int>(scene.spheres.count());
    settings.bounds = scene.bounds;
    settings.periodic = scene.periodic;
    settings.cellSize = scene.cellSize;
    settings.device = device;
    settings.dt = scene.dt;
    settings.gravity = scene.gravity;
    settings.damping = scene.damping;
    return settings;
}

/// Along one axis of a periodic box: how many cells are surely no longer than asked to be with the
/// hair that UniformGrid adds.
inline double wholeCells(float length, const SimulatorSettings& s) {
    const Vec3 size = extent(s.bounds);
    const double longest = maximum(size.x, maximum(size.y, size.z));
    const double hair = (longest / s.cellSize + 2) * 0x1p-20;
    return std::floor(length / (s.cellSize * (1 + hair)));
}

/// The world that the grid covers. A periodic box has whole cells only: the last one along each
/// axis takes what is left over (bodies beyond the grid are in its nearest cell), so that none is
/// shorter than the others.
inline Bounds gridBounds(const SimulatorSettings& s) {
    if (!s.periodic) return s.bounds;
    const auto covered = [&](float length) {
        return static_cast<float>((wholeCells(length, s) - 0.5) * s.cellSize);
    };
    const Vec3 size = extent(s.bounds);
    return {s.bounds.lower,
            s.bounds.lower + Vec3{covered(size.x), covered(size.y), covered(size.z)}};
}

/// InputError if a periodic box is asked for what it cannot have.
inline void requireSensibleBox(const SimulatorSettings& s) {
    if (!(s.gravity == Vec3{}))
        throw InputError("a periodic box has no floor to fall to: use gravity 0, or walls");
    if (s.broadPhase == BroadPhaseMethod::naive)
        throw InputError("a periodic box is searched by its grid: not by the naive broad phase");
    using enum ResponseMethod;
    if (s.response == warm || s.response == smallSteps || s.response == penalty)
        throw InputError("the response " + name(s.response) +
                         " moves bodies against walls, and a periodic box has none: use "
                         "mass-split, racy, atomic, jacobi or coloured there");
    const Vec3 size = extent(s.bounds);
    const float shortest = minimum(size.x, minimum(size.y, size.z));
    if (wholeCells(shortest, s) < 3)
        throw InputError("a periodic box of " + std::to_string(shortest) +
                         " m is too small for cells of " + std::to_string(s.cellSize) +
                         " m: it needs three of them and a hair along every edge");
}

/// InputError naming the first setting that makes no sense.
inline void requireSensible(const SimulatorSettings& s) {
    const auto require = [](bool good, const std::string& message) {
        if (!good) throw InputError(message);
    };
    const Vec3 size = extent(s.bounds);
    require(s.objects > 0, "count " + std::to_string(s.objects) + ": at least 1 ball");
    require(size.x > 0 && size.y > 0 && size.z > 0, "world: upper must lie above lower");
    require(s.cellSize > 0, "cell size " + std::to_string(s.cellSize) + ": must be above 0 m");
    require(s.dt > 0 && s.dt <= 1, "dt " + std::to_string(s.dt) + ": must be above 0, at most 1 s");
    require(isFinite(s.gravity), "gravity: must be a finite number of m/s^2");
    require(s.damping >= 0 && s.damping * s.dt <= 1,
            "damping " + std::to_string(s.damping) + ": must lie between 0 and 1/dt");
    requireSensible(s.response, s);
    if (s.periodic) requireSensibleBox(s);
    require(s.device == Device::cpu || cudaUsable(), whyCudaIsUnusable());
}

/// InputError unless the device has `needed` bytes free.
inline void requireMemory(std::size_t needed, const SimulatorSettings& s) {
    const std::size_t available = freeMemory(s.device);
    if (needed <= available) return;
    const auto gigabytes = [](std::size_t bytes) {
        return std::to_string(static_cast<double>(bytes) / (1024.0 * 1024.0 * 1024.0)) + " GiB";
    };
    throw InputError("count " + std::to_string(s.objects) + " needs " + gigabytes(needed) +
                     ", but " + name(s.device) + " has " + gigabytes(available) +
                     " free: use fewer balls");
}

}  // namespace ballpit
