// The worlds of Bullet and ODE: their knobs, what they keep and report, and how they fail.
#include "common/error.h"
#include "stability/metrics.h"
#include "tests/peer_support.h"

using namespace ballpit;
using namespace ballpit::chart;

TEST_CASE("more iterations press the balls of a column less into each other") {
    const auto [peer, many] = GENERATE(table<Named, int>({{bullet, 50}, {ode, 100}}));
    CAPTURE(peer.name);
    const Scene scene = makeColumn(10, 0);
    const auto overlap = [&](int iterations) {
        const Named with{peer.name, peer.make, iterations};
        return overlapOf(after(with, scene, 2, 1 / 60.0f), scene.bounds).max;
    };
    CHECK(overlap(many) < 0.8 * overlap(peer.iterations));
}

TEST_CASE("a slow ball falls asleep in Bullet as packaged, and in none of the others") {
    const Named peer = eachOf(allPeers);
    const Spheres end = after(peer, ballOnFloor(0, 0.6f, {0.1f, 0, 0}), 4, 1 / 60.0f);
    const bool sleeps = temperatureOf(end) == 0;
    CHECK(sleeps == (std::string(peer.name) == bulletAsPackaged.name));
}

TEST_CASE("a peer gives the same bits each time, whatever it ran before") {
    const Named peer = GENERATE(from_range(std::vector{bullet, bulletAsPackaged, ode}));
    CAPTURE(peer.name);
    const Scene scene = makeSixCubed(0, 1);
    const Spheres once = after(peer, scene, 1, 1 / 60.0f);
    after(peer, makeSixCubed(1, 2), 0.5, 1 / 60.0f);
    CHECK(sameBits(once, after(peer, scene, 1, 1 / 60.0f)));
}

TEST_CASE("a peer changes positions and velocities alone, and counts what touches") {
    const Named peer = eachOf(allPeers);
    Scene scene = worldWithGravity("rest", room);
    addBall(scene, {0, room.lower.y + 0.51f, 0}, {}, 0, 0.5f, 2);
    addBall(scene, {2, room.lower.y + 0.26f, 0}, {}, 0, 0.25f, 3);
    addBall(scene, {0, room.lower.y + 1.77f, 0}, {}, 0, 0.75f, 1);
    const auto world = peer.make(scene, {1 / 60.0f, peer.iterations});
    for (int k = 0; k < 60; ++k) world->step();
    CHECK(world->contacts() == 3);
    const Spheres end = world->spheres();
    CHECK(end.radii == scene.spheres.radii);
    CHECK(end.masses == scene.spheres.masses);
    CHECK(end.restitutions == scene.spheres.restitutions);
    CHECK(end.positions[1].x == Approx(2));
    CHECK(end.positions[1].y - room.lower.y == Approx(0.25).margin(0.01));
    CHECK(end.positions[2].y - room.lower.y == Approx(1.75).margin(0.01));
}

TEST_CASE("a peer refuses damping, a dt of 0 and 0 iterations") {
    const Named peer = eachOf(allPeers);
    Scene scene = ballOnFloor(1, 1);
    CHECK(test::contains(test::messageOf<InputError>([&] { peer.make(scene, {0, 1}); }), "dt"));
    CHECK(test::contains(test::messageOf<InputError>([&] {
                             peer.make(scene, {0.01f, 0});
                         }),
                         "iterations 0"));
    scene.damping = 0.01f;
    CHECK(test::contains(test::messageOf<InputError>([&] {
                             peer.make(scene, {0.01f, 1});
                         }),
                         "damping"));
}

TEST_CASE("what makes ODE end the program is an error here, and the next world is sound") {
    CHECK_THROWS_AS(after(ode, makeNotFinite(), 1, 1 / 60.0f), NotFiniteError);
    const Spheres end = after(ode, headOnScene(1, 1, 1, 1), 1, 1 / 240.0f);
    CHECK(end.velocities[1].x == Approx(3).epsilon(1e-5));
}

TEST_CASE("ODE's direct solver gives up on a column that stands exactly straight, and says so") {
    CHECK_THROWS_AS(after(odeDantzig, makeColumn(10, 0), 1, 1 / 60.0f), SolverGaveUp);
}
