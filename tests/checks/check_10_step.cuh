// Chapter 10's checks of one step as a whole: the stages in their order, the copies, the rounds.
#pragma once

#include "tests/checks/check_10_stages.cuh"

namespace ballpit::check {

/// One step by itself, without the look at its report. False if its result cannot be read.
inline bool oneStepOf(Report& report, Probe& probe, bool rebuild, Spheres& result) {
    const Copies state = probe.bodies().state();
    const Copies end = enqueueStep(probe, state, rebuild);
    if (end.moving < 3 && end.fixed < 3) return readCopies(report, probe, end, result);
    report.fail("copies in which the step ended", text(end.moving) + " and " + text(end.fixed),
                "0, 1 or 2");
    return false;
}

inline void begin(Report& report) {
    // Two balls fly at each other through four cells in one step, and meet in the middle.
    Scene scene{"fast", {}, {{-10, -10, -10}, {10, 10, 10}}, 2.0f, {0, 0, 0}, 0.0f, 1.0f};
    scene.spheres.add({-9, 0.5f, 0.5f}, {8.6f, 0, 0}, 0.5f, 1, 1);
    scene.spheres.add({9, 0.5f, 0.5f}, {-8.6f, 0, 0}, 0.5f, 1, 1);
    scene.spheres.add({3, 3, 3}, {0, 2, 0}, 0.5f, 1, 1);
    Probe probe(scene, report.device, 1);
    Spheres got;
    if (!oneStepOf(report, probe, false, got)) return;
    requireUntouched(report, "the committed copy", probe.bodies().download(), scene.spheres);
    const Spheres expected = composedStep(scene, {.rounds = 1});
    requireSameBalls(report, "two balls that meet", got, expected, 1e-4f);
    report.guess({{"the grid was built before the bodies moved: who meets is not found",
                   [&] { return sameBalls(got, composedStep(scene, {.contacts = false})); }},
                  {"nobody moved", [&] {
                       Scene still = scene;
                       still.dt = 0;
                       return sameBalls(got, composedStep(still, {.contacts = false}));
                   }}});
}

/// The rows after the step: yours, the reference, and yours in red where it is elsewhere or flies
/// otherwise.
inline Frame drawRows(const Spheres& got, const Spheres& expected) {
    constexpr float seconds = 0.09f;  // an arrow shows how far the ball flies in this time
    return threePanels(-2.9f, -2.9f, 5.8f, 300, [&](Canvas& canvas, const Panel& panel, int k) {
        const Spheres& shown = k == 0 ? got : expected;
        for (const Vec3 p : shown.positions) {
            canvas.disc(panel.x(p.x), panel.y(p.y), panel.scale * 0.5f, colors::line);
            canvas.ring(panel.x(p.x), panel.y(p.y), panel.scale * 0.5f, 1.0f, colors::grey);
        }
        for (std::size_t b = 0; b < got.count(); ++b) {
            const Vec3 p = got.positions[b], v = got.velocities[b];
            const bool right = length(p - expected.positions[b]) < 0.02f &&
                               length(v - expected.velocities[b]) < 1e-3f;
            arrow(canvas, panel, shown.positions[b], seconds * shown.velocities[b], 0.18f,
                  k < 2 ? colors::ink : colors::grey);
            if (k < 2 || right) continue;
            canvas.ring(panel.x(p.x), panel.y(p.y), panel.scale * 0.5f, 2.0f, colors::red);
            arrow(canvas, panel, p, seconds * v, 0.18f, colors::red);
        }
    });
}

inline std::vector<Mistake> mistakesOf(const Scene& scene, const Spheres& got, int rounds) {
    const auto with = [&](StepRules rules) {
        return [&scene, &got, rules] { return sameBalls(got, composedStep(scene, rules)); };
    };
    return {{"the contacts changed nothing: does the step go on from what they wrote?",
             with({.contacts = false})},
            {"only one round counts: is there a second, and does it read what the first wrote?",
             with({.rounds = 1})},
            {"the bodies moved in every round: dt was used " + text(rounds) + " times",
             with({.rounds = rounds, .movesInEveryRound = true})},
            {"a round too many", with({.rounds = rounds + 1})},
            {"a round too few", with({.rounds = rounds - 1})}};
}

inline void rounds(Report& report) {
    // Two overlap; pushed apart, each meets a neighbour. The second round must see that.
    Scene row{"row", {}, {{-10, -10, -10}, {10, 10, 10}}, 2.0f, {0, 0, 0}, 0.0f, 0.1f};
    for (const float x : {-1.35f, -0.3f, 0.3f, 1.35f})
        row.spheres.add({x, 0, 0}, {}, 0.5f, 1.0f, 0.5f);
    for (const int rounds : {1, 2}) {
        Probe probe(row, report.device, rounds);
        const Copies end = enqueueStep(probe, probe.bodies().state(), false);
        const Pairs right = rounds == 1 ? Pairs{{1, 2}} : Pairs{{0, 1}, {2, 3}};
        samePairs(report, probe.pairs(end), right, [&](Pair) {
            return std::string(" in round ") + text(rounds) + " of four balls in a row";
        });
    }
    const Scene scene = rowsOfFour();
    for (const bool rebuild : {false, true}) {
        Probe probe(scene, report.device);
        Spheres got;
        if (!oneStepOf(report, probe, rebuild, got)) return;
        const Spheres expected = composedStep(scene, {});
        for (std::size_t k = 0; k < got.count(); ++k) {
            const std::string which = "ball " + text(k % 4) + " of row " + text(k / 4) +
                                      (rebuild ? ", the grid built in every round" : "");
            const float speed = scene.spheres.velocities[k / 4 * 4].x;  // passed on twice
            requireNear(report, "velocity of " + which, got.velocities[k],
                        {k % 4 == 2 ? speed : 0.0f, 0, 0}, 1e-4f);
            requireNear(report, "position of " + which, got.positions[k], expected.positions[k],
                        1e-4f);
        }
        requireUntouched(report, "the committed copy", probe.bodies().download(), scene.spheres);
        report.guess(mistakesOf(scene, got, 2));
        if (report.failed()) return report.picture([&] { return drawRows(got, expected); });
    }
}

/// Balls of all kinds in a box with just enough room, about two contacts each.
inline Scene crowdedBox(int count, float cellSize, std::uint64_t seed) {
    Scene scene{"box", {}, {}, cellSize, {0, -9.81f, 0}, 0.1f, 1.0f / 60.0f};
    scene.spheres = randomScene(count, seed).balls;
    const float side = 0.5f * std::cbrt(static_cast<float>(count)) * 1.3f + 0.5f;
    scene.bounds = {{-side, -side, -side}, {side, side, side}};
    return scene;
}

/// A step of one, two and three rounds. The oracle goes from round to round by itself only from the
/// start; a further round it does from the engine's own state before that. Else two balls that the
/// first has pushed apart to the last bit would touch in one of the two, and not in the other.
inline void requireRounds(Report& report, const Scene& scene, bool rebuild) {
    Spheres before = scene.spheres;
    moveOnHost(before, scene);
    std::vector<bool> decided = decidedByRounding(before);
    for (const int rounds : {1, 2, 3}) {
        Probe probe(scene, report.device, rounds);
        Spheres got;
        if (!oneStepOf(report, probe, rebuild, got)) return;
        Spheres expected = roundOnHost(before);
        for (std::size_t k = 0; k < got.count(); ++k)
            if (rounds == 1 && decided[k]) {
                expected.positions[k] = got.positions[k];
                expected.velocities[k] = got.velocities[k];
            }
        requireSameBalls(
            report,
            text(got.count()) + " balls, " + text(rounds) + (rounds == 1 ? " round" : " rounds"),
            got, expected, 5e-4f);
        report.guess(mistakesOf(scene, got, rounds));
        if (report.failed()) return;
        before = got;
    }
}

inline void composed(Report& report) {
    for (const int count : {1, 2, 33, 255, 256, 257, 1000}) {
        // Wide cells bear all that moves. In narrow ones the grid must follow.
        for (const bool rebuild : {false, true}) {
            requireRounds(report, crowdedBox(count, rebuild ? 1.3f : 4.0f, report.seed + 6),
                          rebuild);
            if (report.failed()) return;
        }
    }
}

}  // namespace ballpit::check
