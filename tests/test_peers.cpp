// Bullet and ODE as the chart uses them: do they run the scene that we gave them, with our laws of
// contact? How well they do it is the chart's business.
#include <cmath>

#include "stability/metrics.h"
#include "tests/peer_support.h"
#include "truth/collisions.h"
#include "truth/motion.h"

using namespace ballpit;
using namespace ballpit::chart;

namespace {

double energyOf(const Spheres& spheres, const Scene& scene, float dt) {
    return measure(spheres, scene.bounds, scene.gravity, dt).shadowEnergy;
}

/// Energy after `seconds` over energy at the start.
double energyRatio(const Named& peer, const Scene& scene, double seconds, float dt) {
    return energyOf(after(peer, scene, seconds, dt), scene, dt) /
           energyOf(scene.spheres, scene, dt);
}

}  // namespace

TEST_CASE("elastic balls of a peer swap their velocities head-on, however slow") {
    const Named peer = eachOf(bouncers);
    const float speed = GENERATE(3.0f, 0.1f);  // m/s
    const Spheres end = after(peer, headOnScene(1, 1, 1, 1, speed), 3 / speed, 1 / 240.0f);
    CHECK(end.velocities[0].x == Approx(0).margin(1e-5));
    CHECK(end.velocities[1].x == Approx(speed).epsilon(1e-5));
}

TEST_CASE("a peer knows masses, and gives a contact the smaller restitution of the two") {
    const Named peer = eachOf(bouncers);
    const Spheres end = after(peer, headOnScene(1, 4, 0.8f, 0.5f), 1, 1 / 240.0f);
    const truth::LineSpeeds right = truth::headOn(1, 3, 4, 0, 0.5);
    CHECK(end.velocities[0].x == Approx(right.first).epsilon(1e-4));
    CHECK(end.velocities[1].x == Approx(right.second).epsilon(1e-4));
}

TEST_CASE("a ball of a peer falls by the semi-implicit rule with the step that was asked for") {
    const Named peer = eachOf(allPeers);
    const float dt = GENERATE(1 / 30.0f, 1 / 60.0f, 1 / 960.0f);
    const Spheres end = after(peer, ballOnFloor(1, 8), 0.5, dt);
    const truth::Fall right = truth::semiImplicitFall({room.lower.y + 8, 0}, gravityOfEarth, dt, 1,
                                                      int(std::lround(0.5 / dt)));
    CHECK(end.positions[0].y == Approx(right.height).margin(2e-4));
    CHECK(end.velocities[0].y == Approx(right.speed).epsilon(1e-4));
}

TEST_CASE("all six walls of a peer throw an elastic ball back") {
    const Named peer = eachOf(bouncers);
    const Vec3 way = GENERATE(Vec3{4, 0, 0}, Vec3{-4, 0, 0}, Vec3{0, 4, 0}, Vec3{0, -4, 0},
                              Vec3{0, 0, 4}, Vec3{0, 0, -4});
    const Vec3 end = after(peer, ballAtWall(way), 2, 1 / 240.0f).velocities[0];
    CHECK(length(end + way) == Approx(0).margin(1e-4));
}

TEST_CASE("balls of a peer have no friction: on the floor they slide as fast as ever") {
    const Named peer = eachOf(allPeers);
    const Spheres end = after(peer, ballOnFloor(0, 0.52f, {1.5f, 0, -0.5f}), 2, 1 / 240.0f);
    CHECK(end.velocities[0].x == Approx(1.5).epsilon(1e-4));
    CHECK(end.velocities[0].z == Approx(-0.5).epsilon(1e-4));
}

TEST_CASE("a dull ball of a peer comes to rest on the floor and stays there") {
    const Named peer = eachOf(allPeers);
    const Spheres end = after(peer, ballOnFloor(0, 1), 3, 1 / 60.0f);
    CHECK(end.positions[0].y - room.lower.y == Approx(ballRadius).epsilon(0.02));
    CHECK(std::abs(end.velocities[0].y) < 0.01f);
}

TEST_CASE("elastic bounces keep their energy in ODE, and in Bullet as its author advises") {
    const Named peer = eachOf(bouncers);
    CHECK(energyRatio(peer, makeBounce(1), 10, 1 / 240.0f) == Approx(1).margin(0.01));
}

TEST_CASE("ODE's bounces have the energy error that SimBenchmark has published") {
    const auto [dt, published] = GENERATE(table<float, double>({{1e-3f, 5.7e-4}, {1e-2f, 5.7e-3}}));
    const Scene scene = makeBounce(1);
    const auto world = makeOde(scene, {dt, odeIterations});
    const auto energy = [&] {
        const Metrics now = measure(world->spheres(), scene.bounds, scene.gravity, dt);
        return now.kineticEnergy + now.potentialEnergy;
    };
    const double start = energy();
    const int steps = int(std::lround(20 / dt));
    double sumOfSquares = 0;
    for (int k = 0; k < steps; ++k) {
        world->step();
        sumOfSquares += std::pow(energy() / start - 1, 2);
    }
    CHECK(std::sqrt(sumOfSquares / steps) == Approx(published).epsilon(0.02));
}

TEST_CASE("as packaged, Bullet gains energy at floors and sticks to walls: why we set it up") {
    CHECK(energyRatio(bulletAsPackaged, makeBounce(1), 10, 1 / 240.0f) > 1.2);
    CHECK(length(after(bulletAsPackaged, ballAtWall({4, 0, 0}), 2, 1 / 240.0f).velocities[0]) < 1);
}

TEST_CASE("a thousand balls in a box overlap as much as these engines are known for") {
    const auto [peer, least, most] = GENERATE(table<Named, double, double>(
        {{bullet, 0.002, 0.01}, {bulletAsPackaged, 0.002, 0.01}, {ode, 0.0008, 0.004}}));
    CAPTURE(peer.name);
    const Scene scene = makeDeepPile(1000, 1);
    const Metrics end =
        measure(after(peer, scene, 2, 1 / 60.0f), scene.bounds, scene.gravity, 1 / 60.0f);
    CHECK(end.lost == 0);
    CHECK(end.meanPenetration > least);  // m; r is 0.5 m
    CHECK(end.meanPenetration < most);
}
