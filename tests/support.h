// What the tests share: the devices present, brute force, and scenes of a few balls.
#pragma once

#include <algorithm>
#include <bit>
#include <iostream>
#include <string>
#include <vector>

#include "10_full_system/physics_simulator.cuh"
#include "common/metrics.h"
#include "common/scene.h"
#include "tests/catch.h"

namespace ballpit::test {

/// Every device of this machine: tests run on each.
inline std::vector<Device> devices() {
    return cudaUsable() ? std::vector{Device::cpu, Device::cuda} : std::vector{Device::cpu};
}

/// For cases that make sense on a GPU alone. CTest reads this line and reports the test as
/// skipped, never as passed.
inline bool skippedWithoutGpu() {
    if (cudaUsable()) return false;
    std::cout << "SKIPPED: " << whyCudaIsUnusable() << std::endl;
    return true;
}

/// Turns the launch order for a scope.
class InOrder {
public:
    explicit InOrder(LaunchOrder order) : before_(launchOrder()) { launchOrder() = order; }
    ~InOrder() { launchOrder() = before_; }

private:
    LaunchOrder before_;
};

/// All touching pairs by comparing every two bodies: the oracle. The touch rule is written out
/// again here, so that a mistake in the engine's own is seen.
inline std::vector<Pair> bruteForcePairs(const Spheres& spheres) {
    std::vector<Pair> pairs;
    for (std::uint32_t a = 0; a < spheres.count(); ++a) {
        for (std::uint32_t b = a + 1; b < spheres.count(); ++b) {
            const Vec3 p = spheres.positions[a], q = spheres.positions[b];
            const float dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z;
            const float reach = spheres.radii[a] + spheres.radii[b];
            if (dx * dx + dy * dy + dz * dz < reach * reach) pairs.push_back({a, b});
        }
    }
    return pairs;
}

/// What the exception says that `call` throws; an exception of another type goes on.
template <class Error, class Call>
std::string messageOf(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "(nothing was thrown)";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The floats of a list of vectors as bits, for comparisons in which -0 is not 0 and NaN is NaN.
inline std::vector<std::uint32_t> bitsOf(const std::vector<Vec3>& values) {
    std::vector<std::uint32_t> bits;
    for (const Vec3 v : values)
        for (const float value : {v.x, v.y, v.z})
            bits.push_back(std::bit_cast<std::uint32_t>(value));
    return bits;
}
inline std::vector<std::uint32_t> bitsOf(const std::vector<float>& values) {
    std::vector<std::uint32_t> bits;
    for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
    return bits;
}

using ballpit::settingsFor;

/// An empty world for a handful of balls: 20 m a side around the origin, no gravity, no damping.
inline Scene emptyWorld(float cellSize = 2.0f) {
    return {"test", {}, {{-10, -10, -10}, {10, 10, 10}}, cellSize, {0, 0, 0}, 0.0f, 1.0f / 60.0f};
}

/// The state after `steps` steps.
inline Spheres simulate(const Scene& scene, const SimulatorSettings& settings, int steps) {
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    for (int k = 0; k < steps; ++k) simulator.step();
    return simulator.bodies().download();
}

}  // namespace ballpit::test

// Catch2 prints both values of a failed comparison; these tell it how.
namespace ballpit {
inline std::ostream& operator<<(std::ostream& out, Vec3 v) {
    return out << '(' << v.x << ", " << v.y << ", " << v.z << ')';
}
inline std::ostream& operator<<(std::ostream& out, Pair pair) {
    return out << '(' << pair.first << ", " << pair.second << ')';
}
inline std::ostream& operator<<(std::ostream& out, Device device) { return out << name(device); }
}  // namespace ballpit
