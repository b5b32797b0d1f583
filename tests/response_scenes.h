// What the tests of the responses share: the methods, and scenes that are hard for some of them.
#pragma once

#include <cmath>

#include "common/random.h"
#include "tests/support.h"

namespace ballpit::test {

/// The responses of chapter 11.
inline std::vector<ResponseMethod> newMethods() {
    using enum ResponseMethod;
    return {jacobi, coloured, warm, smallSteps, penalty};
}

/// Every response whose result does not depend on the order of the threads.
inline std::vector<ResponseMethod> exactMethods() {
    std::vector<ResponseMethod> methods = newMethods();
    methods.push_back(ResponseMethod::massSplit);
    return methods;
}

inline SimulatorSettings settingsFor(const Scene& scene, Device device, ResponseMethod method) {
    SimulatorSettings settings = ballpit::settingsFor(scene, device);
    settings.response = method;
    return settings;
}

inline Metrics measureIn(const Scene& scene, const Spheres& spheres) {
    return measure(spheres, scene.bounds, scene.gravity, scene.dt);
}

/// Equal balls (r 0.5 m, 1 kg) on a lattice that fill the share `phi` of a cube, with velocities at
/// random; no gravity.
inline Scene gasOf(int count, double phi, float restitution, float speed, std::uint64_t seed) {
    const float side = static_cast<float>(std::cbrt(count * 0.5235987755982988 / phi));
    Scene scene{"gas", {}, {{0, 0, 0}, {side, side, side}}, 1.25f, {0, 0, 0}, 0.0f, 1.0f / 60.0f};
    const int along = static_cast<int>(std::ceil(std::cbrt(double(count))));
    const float spacing = (side - 1.0f) / static_cast<float>(along - 1);
    Random random(seed);
    for (int k = 0; k < count; ++k) {
        const Vec3 place{static_cast<float>(k % along), static_cast<float>(k / along % along),
                         static_cast<float>(k / along / along)};
        scene.spheres.add(Vec3{0.5f, 0.5f, 0.5f} + spacing * place,
                          random.uniformIn({{-speed, -speed, -speed}, {speed, speed, speed}}), 0.5f,
                          1.0f, restitution);
    }
    return scene;
}

/// What became of a gas: its energy after so many collisions a ball, relative to the start, and the
/// largest on the way. Infinite once a body is not finite.
struct GasEnergy {
    double final, largest;
};

inline GasEnergy energyAfterCollisions(const Scene& scene, const SimulatorSettings& settings,
                                       double collisionsPerBall) {
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    const double start = measureIn(scene, scene.spheres).kineticEnergy;
    const double wanted = collisionsPerBall * static_cast<double>(scene.spheres.count()) / 2.0;
    GasEnergy energy{1.0, 1.0};
    try {
        double collisions = 0.0;
        for (int k = 0; collisions < wanted && k < 20000; ++k) {
            collisions += simulator.step().collisions;
            if (k % 10) continue;
            energy.final = measureIn(scene, simulator.bodies().download()).kineticEnergy / start;
            energy.largest = std::max(energy.largest, energy.final);
            if (energy.final > 1e6) break;
        }
    } catch (const NotFiniteError&) {
        energy.final = energy.largest = INFINITY;
    }
    return energy;
}

/// Balls of radius 0.5 m, one on top of the other, that touch.
inline Scene columnOf(int count) {
    Scene scene = emptyWorld(1.25f);
    scene.bounds = {{-2, 0, -2}, {2, static_cast<float>(count) + 2.0f, 2}};
    scene.gravity = {0, -9.81f, 0};
    for (int k = 0; k < count; ++k)
        scene.spheres.add({0, 0.5f + static_cast<float>(k), 0}, {0, 0, 0}, 0.5f, 1.0f, 0.0f);
    return scene;
}

/// Equal balls (r 0.5 m) that fall from rest into a box with a floor of 10 m x 10 m.
inline Scene pileOf(int count, float restitution, std::uint64_t seed) {
    constexpr float width = 10.0f, spacing = 1.1f;
    constexpr int along = 8;
    Scene scene = emptyWorld(1.25f);
    scene.bounds = {{0, 0, 0}, {width, static_cast<float>(count) * 0.02f + 5.0f, width}};
    scene.gravity = {0, -9.81f, 0};
    Random random(seed);
    for (int k = 0; k < count; ++k) {
        const Vec3 place{static_cast<float>(k % along), static_cast<float>(k / along / along),
                         static_cast<float>(k / along % along)};
        scene.spheres.add(Vec3{0.7f, 0.6f, 0.7f} + spacing * place +
                              random.uniformIn({{-0.04f, 0, -0.04f}, {0.04f, 0.05f, 0.04f}}),
                          {0, 0, 0}, 0.5f, 1.0f, restitution);
    }
    return scene;
}

}  // namespace ballpit::test

namespace ballpit {
inline std::ostream& operator<<(std::ostream& out, ResponseMethod method) {
    return out << name(method);
}
}  // namespace ballpit
