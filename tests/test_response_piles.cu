// Piles and columns under gravity: which responses hold them up, and which let them sink. And the
// promise behind one list of pairs for many substeps: no pair is missed.
#include "common/host_pairs.h"
#include "stability/scenes.h"
#include "tests/response_scenes.h"

using namespace ballpit;

namespace {

/// Of balls of radius 0.5 m that have been at rest for a while, in radii.
struct Overlap {
    double mean, largest;
};

Overlap overlapAfter(const Scene& scene, const SimulatorSettings& settings, int steps) {
    const Metrics m = test::measureIn(scene, test::simulate(scene, settings, steps));
    CHECK(m.lost == 0);
    return {m.meanPenetration / 0.5, m.largestPenetration / 0.5};
}

Overlap columnUnder(ResponseMethod method, int balls) {
    const Scene scene = test::columnOf(balls);
    return overlapAfter(scene, test::settingsFor(scene, Device::cpu, method), 240);
}

/// 1500 balls, 23 layers deep, fall and come to rest.
Overlap pileUnder(ResponseMethod method) {
    const Scene scene = test::pileOf(1500, 0.3f, 1);
    return overlapAfter(scene, test::settingsFor(scene, Device::cpu, method), 300);
}

}  // namespace

TEST_CASE("small-steps holds a deep pile: overlaps of 0.3 % of a radius, 3 % at most",
          "[stability][long]") {
    const Overlap overlap = pileUnder(ResponseMethod::smallSteps);
    CHECK(overlap.mean < 0.003);
    CHECK(overlap.largest < 0.03);
}

// What is left of an overlap is speed in the next substep, and is taken away there. So a heap that
// has come to rest shows speeds of about g dt that lead nowhere.
TEST_CASE("under small-steps a heap at rest quivers in its place", "[stability][long]") {
    const Scene scene = stability::makeDeepPile(1500, 1);
    PhysicsSimulator simulator(test::settingsFor(scene, Device::cpu, ResponseMethod::smallSteps));
    simulator.bodies().upload(scene.spheres);
    constexpr int second = 60;
    for (int step = 0; step < 9 * second; ++step) simulator.step();
    const std::vector<Vec3> before = simulator.bodies().positions.download();
    for (int step = 0; step < second; ++step) simulator.step();
    const Spheres end = simulator.bodies().download();
    double squares = 0.0;
    for (std::size_t k = 0; k < before.size(); ++k)
        squares += double(lengthSquared(end.positions[k] - before[k]));
    const double moved = std::sqrt(squares / 1500.0);
    const double speed = std::sqrt(2.0 * test::measureIn(scene, end).kineticEnergy / 1500.0);
    CHECK(speed < 9.81 / 60.0);
    CHECK(moved < 0.5 * speed);
}

TEST_CASE("penalty and warm hold a deep pile softly: overlaps of some per cent",
          "[stability][long]") {
    CHECK(pileUnder(ResponseMethod::penalty).mean < 0.03);
    CHECK(pileUnder(ResponseMethod::warm).mean < 0.05);
}

TEST_CASE("mass-split fails in a deep pile: it sinks into itself", "[stability][long]") {
    CHECK(pileUnder(ResponseMethod::massSplit).mean > 0.2);
}

TEST_CASE("coloured and jacobi fail in a deep pile", "[stability][long]") {
    const ResponseMethod method = GENERATE(ResponseMethod::coloured, ResponseMethod::jacobi);
    CAPTURE(method);
    const Scene scene = test::pileOf(1500, 0.3f, 1);
    const Metrics m = test::measureIn(
        scene, test::simulate(scene, test::settingsFor(scene, Device::cpu, method), 300));
    CHECK(m.meanPenetration / 0.5 > 0.1);
}

TEST_CASE("a column of twenty: impulses that remember hold it, impulses that forget do not",
          "[stability]") {
    CHECK(columnUnder(ResponseMethod::warm, 20).largest < 0.1);
    CHECK(columnUnder(ResponseMethod::smallSteps, 20).largest < 0.1);
    const Scene scene = test::columnOf(20);
    for (const ResponseMethod method : {ResponseMethod::coloured, ResponseMethod::massSplit}) {
        const Spheres end =
            test::simulate(scene, test::settingsFor(scene, Device::cpu, method), 240);
        CHECK(test::measureIn(scene, end).largestPenetration / 0.5 > 1.0);
    }
}

TEST_CASE("coloured holds a column of three", "[stability]") {
    CHECK(columnUnder(ResponseMethod::coloured, 3).largest < 0.2);
}

TEST_CASE("a pile under warm comes to rest, under coloured it boils", "[stability][long]") {
    const Scene scene = test::pileOf(500, 0.0f, 2);
    const auto speed = [&](ResponseMethod method) {
        const Spheres end =
            test::simulate(scene, test::settingsFor(scene, Device::cpu, method), 500);
        return std::sqrt(2.0 * test::measureIn(scene, end).kineticEnergy / 500.0);
    };
    const double fallOfAStep = 9.81 / 60.0;
    CHECK(speed(ResponseMethod::warm) < fallOfAStep);
    CHECK(speed(ResponseMethod::coloured) > 2.0 * fallOfAStep);
}

TEST_CASE("small-steps fails with a crowd that overlaps from the start: the overlap becomes speed",
          "[stability]") {
    // 2 % of a diameter at every contact, and no room to give way to.
    const Scene scene = makePile(1000, 1);
    const auto energyGained = [&](ResponseMethod method) {
        const Spheres end = test::simulate(scene, test::settingsFor(scene, Device::cpu, method), 5);
        return test::measureIn(scene, end).shadowEnergy -
               test::measureIn(scene, scene.spheres).shadowEnergy;
    };
    CHECK(energyGained(ResponseMethod::smallSteps) > 1000.0);
    CHECK(energyGained(ResponseMethod::coloured) < 10.0);
    CHECK(energyGained(ResponseMethod::warm) < 10.0);
}

namespace {

/// A crowd of balls, fast and slow, of mixed sizes: many of them change their ways within a step.
Scene rush(float speed, std::uint64_t seed) {
    Scene scene = test::gasOf(1000, 0.45, 0.8f, speed, seed);
    Random random(seed);
    for (std::size_t k = 0; k < scene.spheres.count(); ++k) {
        scene.spheres.radii[k] = random.uniform(0.4f, 0.5f);
        if (k % 3) scene.spheres.velocities[k] = {};
    }
    return scene;
}

bool isListed(const std::vector<Pair>& list, Pair pair) {
    return std::binary_search(list.begin(), list.end(), pair);
}

}  // namespace

TEST_CASE("no pair is missed by the list that serves all substeps of a step", "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    const ResponseMethod method = GENERATE(ResponseMethod::smallSteps, ResponseMethod::penalty);
    const float speed = GENERATE(0.5f, 2.0f, 6.0f);
    CAPTURE(device, method, speed);
    const Scene scene = rush(speed, 7);
    PhysicsSimulator simulator(test::settingsFor(scene, device, method));
    simulator.bodies().upload(scene.spheres);
    std::size_t shared = 0, missed = 0, touching = 0;
    int doublings = 0;
    for (int step = 0; step < 60; ++step) {
        const StepStats stats = simulator.step();
        doublings = std::max(doublings, simulator.slack().doublings());
        if (stats.gridRebuilt) continue;
        ++shared;
        // The list is from the first substep, the bodies from after the last.
        const std::vector<Pair> list = simulator.lastPairs();
        for (const Pair pair : findPairsOnHost(simulator.bodies().download())) {
            ++touching;
            missed += !isListed(list, pair);
        }
    }
    CAPTURE(shared, touching);
    CHECK(missed == 0);
    if (speed < 1.0f) CHECK(shared > 0);
    if (speed > 1.0f && method == ResponseMethod::smallSteps) CHECK(doublings > 0);
}

namespace {

/// 3000 balls that fall 2 m into a box, half a second before they lie: fast ones strike slow ones.
Scene fall() { return stability::makeDeepPile(3000, 1); }

}  // namespace

TEST_CASE("balls that fall into a heap need longer reaches, not a list for each substep",
          "[stability]") {
    const Scene scene = fall();
    PhysicsSimulator simulator(test::settingsFor(scene, Device::cpu, ResponseMethod::smallSteps));
    simulator.bodies().upload(scene.spheres);
    int rebuilt = 0, widest = 0;
    for (int step = 0; step < 90; ++step) {
        rebuilt += simulator.step().gridRebuilt;
        widest = std::max(widest, simulator.slack().doublings());
    }
    CHECK(rebuilt == 0);
    CHECK(widest > 0);
}

TEST_CASE("longer reaches are given up again after a while", "[stability]") {
    ReachSlack slack;
    CHECK_FALSE(slack.doublings());
    CHECK(slack.widen(100));
    CHECK(slack.widen(101));
    CHECK_FALSE(slack.widen(102));
    CHECK(slack.inRadii() == 0.2f);
    slack.narrow(116);
    CHECK(slack.doublings() == 2);
    slack.narrow(117);
    slack.narrow(117);
    CHECK(slack.doublings() == 1);
    slack.narrow(133);
    CHECK(slack.doublings() == 0);
}

TEST_CASE("a full pair list and rehearsals change no bit of balls that leave their reach",
          "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    const Scene scene = fall();
    SimulatorSettings settings = test::settingsFor(scene, device, ResponseMethod::smallSteps);
    const std::uint64_t plain = stateHash(test::simulate(scene, settings, 120));
    settings.pairCapacity = 64;
    CHECK(stateHash(test::simulate(scene, settings, 120)) == plain);
    PhysicsSimulator simulator(test::settingsFor(scene, device, ResponseMethod::smallSteps));
    simulator.bodies().upload(scene.spheres);
    for (int k = 0; k < 120; ++k) {
        simulator.rehearseStep();
        simulator.step();
    }
    CHECK(stateHash(simulator.bodies().download()) == plain);
}

TEST_CASE("a ball that is struck and leaves its reach has the step repeated, and hits the next",
          "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld(1.25f);
    // The first substep's end finds a touching b; b then meets c, from which it was far.
    scene.spheres.add({-1.02f, 0, 0}, {30, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({0, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({1.25f, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    PhysicsSimulator simulator(test::settingsFor(scene, device, ResponseMethod::smallSteps));
    simulator.bodies().upload(scene.spheres);
    CHECK(simulator.step().gridRebuilt);
    const std::vector<Vec3> velocities = simulator.bodies().velocities.download();
    CHECK(velocities[0].x == Approx(0.0).margin(1e-3));
    CHECK(velocities[1].x == Approx(0.0).margin(1e-3));
    CHECK(velocities[2].x == Approx(30.0).epsilon(1e-4));
}

TEST_CASE("a body reports that it left its reach, at the reach not yet, lost in NaN always",
          "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    struct Case {
        float x;
        bool left;
    };
    const Case c = GENERATE(Case{0.25f, false}, Case{std::nextafter(0.25f, 1.0f), true},
                            Case{-0.25f, false}, Case{std::nanf(""), true});
    CAPTURE(device, c.x);
    DeviceBuffer<Vec4> positions(device, 1, "positions"), grown(device, 1, "grown");
    DeviceBuffer<StepStatus> status(device, 1, "status");
    status.fill(0);
    positions.upload(std::vector<Vec4>{{c.x, 0, 0, 0.5f}});
    grown.upload(std::vector<Vec4>{{0, 0, 0, 0.75f}});
    BodiesView bodies;
    bodies.positions = positions.view();
    launch<reportReach>(device, 1, bodies, View<const Vec4>(grown.view()), status.view());
    CHECK((status.download()[0].staleGrid == 1) == c.left);
}

TEST_CASE("a reach is at least the way a free ball makes, as far as the cells allow",
          "[stability]") {
    const ReachSettings settings{0.02f, 9.81f, 0.05f, 0.7f};
    CHECK(reachOf(0.5f, 0.0f, settings) >= 0.02f * 0.02f * 9.81f);
    CHECK(reachOf(0.5f, 3.0f, settings) >= 0.02f * (3.0f + 0.02f * 9.81f));
    CHECK(reachOf(0.5f, 300.0f, settings) == Approx(0.2).epsilon(1e-5));
    CHECK(reachOf(0.7f, 300.0f, settings) == 0.0f);
}

TEST_CASE("steps count the pairs that touch, not those within reach", "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    Scene scene = test::emptyWorld(1.25f);
    scene.spheres.add({0, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({1.01f, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({0, 0.99f, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    PhysicsSimulator simulator(test::settingsFor(scene, device, ResponseMethod::penalty));
    simulator.bodies().upload(scene.spheres);
    CHECK(simulator.step().collisions == 1);
    CHECK(simulator.lastPairs() == std::vector<Pair>{{0, 1}, {0, 2}});
}
