// Chapter 11's executable: scenes that one method fails and another holds, side by side; and how
// all methods fare in the same scenes (--scene methods), or how fast they are (--time).
#include "chapters/11_stability/duel_film.cuh"
#include "chapters/11_stability/examples.cuh"
#include "chapters/11_stability/ranking.cuh"

using namespace ballpit;

/// What became of both sides after the duel's steps; for figures, also on the way there.
static void tell(Findings& findings, const Duel& duel, const Options& options) {
    Match match(duel, options);
    std::vector<double> tracks[2];
    for (int step = 0; step < duel.steps; ++step) {
        match.step();
        for (int side = 0; side < 2; ++side)
            if (options.json) tracks[side].push_back(duel.track(match.sides[side]));
    }
    for (int k = 0; k < 2; ++k) {
        Side& side = match.sides[k];
        const std::string who = duel.scene + ", " + side.methodName() + ": ";
        findings.add(who + duel.measure, duel.value(side));
        findings.add(who + "state hash", hashText(stateHash(side.balls())));
        findings.list(who + "track", tracks[k]);
    }
}

static int run(const Options& options) {
    Findings findings("11 stability: one scene, two methods");
    if (options.time || options.scene == "methods") {
        options.time ? tellSpeeds(findings, options) : tellRanking(findings, options);
        findings.print(options.json);
        return 0;
    }
    const std::vector<Duel> duels = duelsNamed(options.scene);
    const bool isShown = options.isFilmed() || !options.png.empty();
    if (isShown && duels.size() > 1)
        throw InputError("a picture or a film shows one scene: say which with --scene");
    for (const Duel& duel : duels) tell(findings, duel, options);
    tellExample(findings);
    findings.print(options.json);
    if (isShown) filmDuel(duels.front(), options);
    return 0;
}

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Where methods fail: one scene under two of them",
                      {.scene = "all", .sceneChoice = sceneChoice(), .frames = 240}, run);
}
