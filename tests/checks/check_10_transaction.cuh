// Chapter 10's checks of the step as a transaction: committed, repeated, or failed without loss.
#pragma once

#include "tests/checks/check_10_step.cuh"

namespace ballpit::check {

inline Spheres simulated(const Scene& scene, const SimulatorSettings& settings, int steps) {
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    for (int k = 0; k < steps; ++k) simulator.step();
    return simulator.bodies().download();
}

inline void commits(Report& report) {
    Scene scene{"fall", {}, {{-10, -100, -10}, {10, 10, 10}}, 2.0f, {0, -10, 0}, 0.0f, 0.1f};
    scene.spheres.add({0, 0, 0}, {}, 0.5f, 1, 1);
    PhysicsSimulator simulator(settingsFor(scene, report.device));
    simulator.bodies().upload(scene.spheres);
    for (int step = 1; step <= 7; ++step) {
        const std::uint64_t before = stateHash(simulator.bodies().download());
        simulator.rehearseStep();
        if (stateHash(simulator.bodies().download()) != before)
            report.fail("a rehearsal has changed the state before step " + text(step));
        simulator.step();
        const double n = step;  // v = -n, y = -0.1 (1 + 2 + ... + n)
        const float height = simulator.bodies().positions.download()[0].y;
        requireNear(report, "height after " + text(step) + " steps of a fall, m", height,
                    -0.05 * n * (n + 1), 1e-5 * n * n);
        requireNear(report, "speed after " + text(step) + " steps of a fall, m/s",
                    simulator.bodies().velocities.download()[0].y, -n, 1e-4);
        if (step == 1)
            report.guess(
                {{"the state is still that from before the step: commit the copies in "
                  "which the step ended",
                  [&] { return height == 0.0f; }}});
        if (report.failed()) return;
    }
}

/// A list of 16 places for a pile of 1000 balls at rest: one step, told and complete.
inline void growsOnce(Report& report, const Scene& scene, const SimulatorSettings& tight) {
    SimulatorSettings roomy = tight;
    roomy.pairCapacity = 100000;
    const Pairs right = findPairsOnHost(scene.spheres);
    PhysicsSimulator simulator(tight);
    simulator.bodies().upload(scene.spheres);
    const std::size_t reported = 16 + simulator.step().overflow;
    if (reported != right.size())
        report.fail("pairs needed by a pile of 1000 balls, as the caller was told", text(reported),
                    text(right.size()));
    const bool same =
        stateHash(simulator.bodies().download()) == stateHash(simulated(scene, roomy, 1));
    if (!same)
        report.fail("16 places for " + text(right.size()) +
                    " pairs: the state is not that of a list with room for all");
    report.guess({{"the list has grown, but the step was not repeated",
                   [&] { return !same && reported == right.size(); }},
                  {"the report was not looked at: the list stayed as it was",
                   [&] { return reported == 16; }}});
    if (report.failed()) return;
    samePairs(report, simulator.lastPairs(), right,
              [](Pair) { return std::string(" of the pile, after the list has grown"); });
}

/// The list may not grow: both numbers are told, and the state is kept.
inline void refusesToGrow(Report& report, const Scene& scene, SimulatorSettings settings) {
    settings.growPairs = false;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    std::string message = "(no exception)";
    try {
        simulator.step();
    } catch (const std::runtime_error& error) {
        message = error.what();
    }
    const std::string words =
        text(findPairsOnHost(scene.spheres).size()) + " pairs needed, 16 available";
    if (message.find(words) == std::string::npos)
        report.fail("the message with growPairs = false", message, "... " + words + " ...");
    requireUntouched(report, "the state after a list that may not grow",
                     simulator.bodies().download(), scene.spheres);
}

inline void grow(Report& report) {
    Scene scene = makePile(1000, report.seed);
    SimulatorSettings settings = settingsFor(scene, report.device);
    settings.pairCapacity = 16;
    SimulatorSettings roomy = settings;
    roomy.pairCapacity = 100000;
    Scene still = scene;  // nothing moves before the search
    still.gravity = {0, 0, 0};
    for (Vec3& velocity : still.spheres.velocities) velocity = {0, 0, 0};
    SimulatorSettings one = settings;
    one.gravity = still.gravity;
    one.iterations = 1;
    growsOnce(report, still, one);
    if (report.failed()) return;
    refusesToGrow(report, still, one);
    if (stateHash(simulated(scene, settings, 10)) != stateHash(simulated(scene, roomy, 10)))
        report.fail(
            "after 10 steps that began with 16 places the pile is not what it is with "
            "100000");
}

/// Cells of 2 m with faces at even numbers. A heavy ball pushes a light one by 1.4 m from the first
/// cell into the second, onto a ball in the third, which is no neighbour of the first.
inline Scene pushedAcross() {
    Scene scene{"pushed", {}, {{-10, -10, -10}, {10, 10, 10}}, 2.0f, {0, 0, 0}, 0.0f, 0.01f};
    scene.spheres.add({1.8f, 0, 0}, {}, 0.9f, 1e6f, 0.5f);
    scene.spheres.add({1.85f, 0, 0}, {}, 0.5f, 1.0f, 0.5f);
    scene.spheres.add({4.05f, 0, 0}, {}, 0.5f, 1e6f, 0.5f);
    return scene;
}

/// What the second round must find is what lies on each other after a step of one round.
inline void requireSecondRound(Report& report, const std::string& where, const Scene& scene) {
    SimulatorSettings settings = settingsFor(scene, report.device);
    settings.iterations = 1;
    const Pairs right = findPairsOnHost(simulated(scene, settings, 1));
    settings.iterations = 2;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    const bool rebuilt = simulator.step().gridRebuilt;
    const Pairs got = simulator.lastPairs();
    samePairs(report, got, right, [&](Pair) { return " in the second round, " + where; });
    report.guess({{"the stale grid was noticed, but the step was not repeated",
                   [&] { return rebuilt && got.size() < right.size(); }},
                  {"the report of a stale grid was not looked at",
                   [&] { return !rebuilt && got.size() < right.size(); }}});
}

inline void rebuilds(Report& report) {
    requireSecondRound(report, "a ball pushed into the neighbour of its neighbour cell",
                       pushedAcross());
    if (report.failed()) return;
    for (std::uint64_t k = 0; k < 5; ++k)
        requireSecondRound(report, "narrow cells, seed " + text(std::size_t(report.seed + k)),
                           crowdedBox(300, 1.2f, report.seed + k));
    // A ball as wide as a cell has no room: the grid is built in every round, and once is enough.
    Scene wide = pushedAcross();
    wide.spheres.radii[0] = 1.0f;
    for (const int iterations : {1, 2}) {
        SimulatorSettings settings = settingsFor(wide, report.device);
        settings.iterations = iterations;
        PhysicsSimulator simulator(settings);
        simulator.bodies().upload(wide.spheres);
        if (simulator.step().gridRebuilt != (iterations > 1))
            report.fail("a ball as wide as a cell, rounds: " + text(iterations) +
                            ": was the grid built in every round?",
                        iterations > 1 ? "no" : "yes", iterations > 1 ? "yes" : "no");
    }
    // Once stale, it is built in every round for the next steps as well; without need it is not.
    PhysicsSimulator pushed(settingsFor(pushedAcross(), report.device));
    pushed.bodies().upload(pushedAcross().spheres);
    int rebuilt = 0;
    for (int step = 0; step < 20; ++step) rebuilt += pushed.step().gridRebuilt;
    if (rebuilt != 16)
        report.fail("20 steps, stale in the first alone: steps with a grid in every round",
                    text(rebuilt), "16");
}

inline void failedStep(Report& report) {
    Scene scene{"overflow", {}, {{-10, -10, -10}, {10, 10, 10}}, 2.0f, {0, -3e38f, 0}, 0, 1};
    for (const float x : {5.0f, -5.0f, 0.0f}) scene.spheres.add({x, 0, 0}, {}, 0.5f, 1, 1);
    PhysicsSimulator simulator(settingsFor(scene, report.device));
    simulator.bodies().upload(scene.spheres);
    simulator.step();
    Spheres before = simulator.bodies().download();
    before.velocities[2] = before.velocities[1] = {0, -3e38f, 0};  // once more, and it is too much
    simulator.bodies().velocities.upload(before.velocities);
    std::string message = "(no exception)";
    try {
        simulator.step();
    } catch (const NotFiniteError& error) {
        message = error.what();
    }
    const std::string words = "body 1 is not finite after integrate of step 1";
    if (message.find(words) == std::string::npos)
        report.fail("a velocity beyond all numbers", message, words + " ...");
    requireUntouched(report, "the state after a step that failed", simulator.bodies().download(),
                     before);
    simulator.bodies().velocities.upload(std::vector<Vec3>(3));
    simulator.step();  // and it can go on
}

}  // namespace ballpit::check
