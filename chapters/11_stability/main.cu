// Chapter 11's executable: scenes that one method fails and another holds, side by side.
#include "chapters/11_stability/duel_film.cuh"
#include "common/findings.h"

using namespace ballpit;

/// What became of both sides after the duel's steps.
static void tell(Findings& findings, const Duel& duel, const Options& options) {
    Match match(duel, options);
    for (int step = 0; step < duel.steps; ++step) match.step();
    for (Side& side : match.sides) {
        const std::string who = duel.scene + ", " + side.method() + ": ";
        findings.add(who + duel.measure, duel.value(side));
        findings.add(who + "state hash", hashText(stateHash(side.balls())));
    }
}

static int run(const Options& options) {
    const std::vector<Duel> duels = duelsNamed(options.scene);
    const bool isFilmed = !options.out.empty() || !options.png.empty();
    if (isFilmed && duels.size() > 1)
        throw InputError("--png and --out show one scene: say which with --scene");
    Findings findings("11 stability: one scene, two methods");
    for (const Duel& duel : duels) tell(findings, duel, options);
    findings.print(options.json);
    if (isFilmed) filmDuel(duels.front(), options);
    return 0;
}

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Where methods fail: one scene under two of them",
                      {.scene = "all", .sceneChoice = "all, or one of " + duelNames()}, run);
}
