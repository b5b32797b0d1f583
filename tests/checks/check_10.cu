// Checks of chapter 10: whole runs, and the list of all checks.
#include "tests/checks/check_10_transaction.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

/// gravity_fall as `./ballpit demo` shows it.
constexpr int demoSteps = 600;

void fall(Report& report) {
    const Scene scene = makeGravityFall(500, 1);
    PhysicsSimulator simulator(settingsFor(scene, report.device));
    simulator.bodies().upload(scene.spheres);
    std::size_t pairs = 0, rebuilt = 0, grown = 0;
    for (int step = 1; step <= demoSteps; ++step) {
        const StepStats stats = simulator.step();
        pairs += stats.collisions;
        rebuilt += stats.gridRebuilt;
        grown += stats.overflow > 0;
        if (step % 60 != 0) continue;
        const Metrics now =
            measure(simulator.bodies().download(), scene.bounds, scene.gravity, scene.dt);
        const std::string when = " after " + text(step) + " steps";
        requireNear(report, "balls that are not finite" + when, double(now.notFinite), 0);
        requireNear(report, "balls outside the walls" + when, double(now.lost), 0);
        if (report.failed()) return;
    }
    report.measured("600 steps of gravity_fall: " + text(pairs) +
                    " touching pairs in all; the grid was built in every round in " +
                    text(rebuilt) + " steps; the pair list grew " + text(grown) + " times");
}

void goldenHash(Report& report) {
    const Scene scene = makeGravityFall(500, 1);
    const SimulatorSettings settings = settingsFor(scene, report.device);
    const std::string got = hashText(stateHash(simulated(scene, settings, demoSteps)));
    if (got != "9477c493691706c7")
        report.fail("state hash of gravity_fall after 600 steps", got, "9477c493691706c7");
}

void twice(Report& report) {
    const Scene scene = makePile(700, report.seed);
    const SimulatorSettings settings = settingsFor(scene, report.device);
    const std::uint64_t first = stateHash(simulated(scene, settings, 40));
    const std::uint64_t second = stateHash(simulated(scene, settings, 40));
    if (first != second)
        report.fail("state hash of the same 40 steps, run again", hashText(second),
                    hashText(first));
}

void anyOrder(Report& report) {
    const Scene scene = makePile(3000, report.seed);
    const SimulatorSettings settings = settingsFor(scene, report.device);
    inEveryOrder(report, [&] { return stateHash(simulated(scene, settings, 5)); });
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "10",
        {{"system.integrate",
          "Integrate writes the moved bodies to the other copy, and their cells",
          "The cells must be those of the places where the bodies are now.", integrateStage},
         {"system.build_grid",
          "Every body lies in the slots of its cell, also when the grid is built again",
          "Sort, clear, reorder and cells: each needs what the one before has written.",
          buildGridStage},
         {"system.detect", "Detect lists the touching pairs of the bodies in the given copy",
          "A search in another copy finds pairs of slots that hold other bodies by now.",
          detectStage},
         {"system.resolve", "Resolve writes the other copy, and tells when a body moved too far",
          "A grid bears a way of half a cell less the radius. Beyond that, pairs can be missed.",
          resolveStage},
         {"system.copies", "The free copy is neither committed nor in use",
          "A step that writes into the committed copy has nothing to go back to.", copies},
         {"system.begin", "First the bodies move, then the grid is built where they are",
          "A grid from before the motion misses whoever flies into another cell.", begin},
         {"system.rounds", "Each round sees what the round before has written",
          "A blow wanders through a row by one ball a round. Two rounds, two balls.", rounds},
         {"system.one_step",
          "One step of 1 to 1000 balls is the step that an oracle composes in double precision",
          "No grid, no copies, no repeats: every ball against every other.", composed},
         {"system.commit", "After a step the state is the new one, after a rehearsal the old one",
          "A commit is one assignment, and the only moment at which the state changes.", commits},
         {"system.grow",
          "16 places for a pile of 1000 balls: told, grown, repeated, and no pair is lost",
          "The repeat starts from the same bits, so the result is that of a list with room.", grow},
         {"system.rebuild", "A grid that went stale is built in every round: no pair is missed",
          "A missed pair is a ball inside another one, and nothing says why.", rebuilds},
         {"system.failed_step", "A step that fails names the body, and the state is kept",
          "The last good state is what you need to find the cause.", failedStep},
         {"system.fall", "600 steps of gravity_fall: nobody escapes, everything stays finite",
          "What goes wrong once in a thousand steps shows here.", fall},
         {"system.hash", "600 steps of gravity_fall end in the state hash of the README",
          "The same bits on every machine, or one of us has a bug.", goldenHash},
         {"system.twice", "The same run twice gives the same bits",
          "What a run reads before it is written is different every time.", twice},
         {"system.order", "A step gives the same bits in every order of the threads",
          "Then a run on a GPU can be repeated, and compared with yours.", anyOrder}});
}
