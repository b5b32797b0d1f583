// Elastic gases, and what simultaneous contacts do: where each response holds, and where it fails.
// Both are asserted: a failure that goes away is news as well.
#include "07_impulse_response/examples.cuh"
#include "tests/response_scenes.h"

using namespace ballpit;

namespace {

constexpr double collisions = 100.0;  ///< a ball

test::GasEnergy energyOf(ResponseMethod method, double phi, float restitution,
                         double collisionsPerBall = collisions) {
    const Scene scene = test::gasOf(343, phi, restitution, 2.0f, 5);
    return test::energyAfterCollisions(scene, test::settingsFor(scene, Device::cpu, method),
                                       collisionsPerBall);
}

/// Elastic balls in a row that touch; the first comes with 1 m/s. Their speeds in the end.
std::vector<double> cradle(int count, ResponseMethod method, int iterations) {
    Scene scene = test::emptyWorld();
    scene.dt = 1.0f / 64.0f;
    for (int k = 0; k < count; ++k)
        scene.spheres.add({static_cast<float>(k), 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.positions[0].x -= 0.5f * scene.dt;
    scene.spheres.velocities[0] = {1, 0, 0};
    SimulatorSettings settings = test::settingsFor(scene, Device::cpu, method);
    settings.iterations = iterations;
    const Spheres end = test::simulate(scene, settings, 10);
    std::vector<double> speeds;
    for (const Vec3 velocity : end.velocities) speeds.push_back(velocity.x);
    return speeds;
}

}  // namespace

TEST_CASE("coloured holds: a dense elastic gas keeps its energy", "[stability][long]") {
    const double phi = GENERATE(0.05, 0.2, 0.4);
    CAPTURE(phi);
    const test::GasEnergy energy = energyOf(ResponseMethod::coloured, phi, 1.0f);
    CHECK(std::abs(energy.final - 1.0) < 1e-4);
    CHECK(energy.largest < 1.0001);
}

TEST_CASE("jacobi holds in a thin elastic gas and in a dull dense one", "[stability][long]") {
    const test::GasEnergy thin = energyOf(ResponseMethod::jacobi, 0.05, 1.0f);
    CHECK(std::abs(thin.final - 1.0) < 0.1);
    CHECK(thin.largest < 1.1);
    CHECK(energyOf(ResponseMethod::jacobi, 0.4, 0.5f, 20.0).largest <= 1.0);
}

TEST_CASE("jacobi fails in a dense elastic gas: it explodes", "[stability]") {
    CHECK(energyOf(ResponseMethod::jacobi, 0.4, 1.0f).largest > 10.0);
}

TEST_CASE("jacobi with a smaller share of each impulse does not explode, but bounces too little",
          "[stability]") {
    const Scene scene = test::gasOf(343, 0.4, 1.0f, 2.0f, 5);
    SimulatorSettings settings = test::settingsFor(scene, Device::cpu, ResponseMethod::jacobi);
    settings.relaxation = 0.5f;
    const test::GasEnergy energy = test::energyAfterCollisions(scene, settings, 20.0);
    CHECK(energy.largest <= 1.0001);
    CHECK(energy.final < 0.5);
}

TEST_CASE("mass-split holds in that it never gains, and fails in that it loses most",
          "[stability][long]") {
    const test::GasEnergy energy = energyOf(ResponseMethod::massSplit, 0.4, 1.0f);
    CHECK(energy.largest <= 1.00001);
    CHECK(energy.final < 0.5);
}

TEST_CASE("small-steps holds: a dense elastic gas keeps its energy", "[stability][long]") {
    const double phi = GENERATE(0.1, 0.4);
    CAPTURE(phi);
    const test::GasEnergy energy = energyOf(ResponseMethod::smallSteps, phi, 1.0f, 30.0);
    CHECK(std::abs(energy.final - 1.0) < 1e-3);
    CHECK(energy.largest < 1.001);
}

TEST_CASE("warm fails in a dense elastic gas: it loses energy", "[stability]") {
    const test::GasEnergy energy = energyOf(ResponseMethod::warm, 0.4, 1.0f, 30.0);
    CHECK(energy.largest <= 1.001);
    CHECK(energy.final < 0.8);
}

TEST_CASE("penalty holds in a dense elastic gas", "[stability][long]") {
    // Some of the energy is in the springs at any time.
    const test::GasEnergy energy = energyOf(ResponseMethod::penalty, 0.4, 1.0f);
    CHECK(std::abs(energy.final - 1.0) < 0.1);
    CHECK(energy.largest < 1.01);
}

TEST_CASE("penalty fails with a bullet: it passes through a ball", "[stability]") {
    Scene scene = test::emptyWorld();
    const float speed = GENERATE(5.0f, 400.0f);
    CAPTURE(speed);
    scene.bounds = {{-60, -10, -10}, {60, 10, 10}};
    scene.spheres.add({-2, 0, 0}, {speed, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({0, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    SimulatorSettings settings = test::settingsFor(scene, Device::cpu, ResponseMethod::penalty);
    const int steps = static_cast<int>(4.0f / speed * 60.0f) + 2;
    const Spheres end = test::simulate(scene, settings, steps);
    const bool passed = end.positions[0].x > end.positions[1].x;
    CHECK(passed == (speed > 100.0f));
}

TEST_CASE("warm fails in Newton's cradle: all contacts are solved as one", "[stability]") {
    const std::vector<double> three = cradle(3, ResponseMethod::warm, 200);
    CHECK(three[0] == Approx(-1.0 / 3.0).margin(1e-3));
    CHECK(three[1] == Approx(2.0 / 3.0).margin(1e-3));
    CHECK(three[2] == Approx(2.0 / 3.0).margin(1e-3));
}

TEST_CASE("coloured holds in Newton's cradle, since each pair sees what the last has done",
          "[stability]") {
    const std::vector<double> five = cradle(5, ResponseMethod::coloured, 8);
    for (const int k : {0, 1, 2, 3}) CHECK(five[std::size_t(k)] == Approx(0.0).margin(1e-3));
    CHECK(five[4] == Approx(1.0).margin(1e-3));
}

TEST_CASE("one ball into a pocket of three: jacobi trebles the energy, coloured keeps it",
          "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    const Example example = pocketOfThree();
    const ContactRules rules{1.0f, 1.0f, 0.0f};
    JacobiResponse jacobi(device, 4, 3, rules);
    ColouredResponse coloured(device, 4, 3, rules);
    CHECK(kineticEnergy(resolved(device, example, jacobi)) == Approx(1.5).epsilon(1e-5));
    CHECK(kineticEnergy(resolved(device, example, coloured)) == Approx(0.5).epsilon(1e-5));
}
