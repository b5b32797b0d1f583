// Checks of chapter 11: where each method fails and another holds, and the list of all checks.
#include "tests/checks/check_11_steps.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

using enum ResponseMethod;

/// "coloured 1.06, warm 0.00291": `value` of each method.
template <class Value>
std::string ofEach(const std::vector<ResponseMethod>& methods, Value value) {
    std::string found;
    for (const ResponseMethod method : methods) {
        if (!found.empty()) found += ", ";
        found += name(method) + " " + brief(value(method));
    }
    return found;
}

void sameBits(Report& report) {
    // So many balls that the CPU's loops are split among threads.
    const Scene scene = stability::makeGasOf({.count = 2500,
                                              .volumeShare = 0.4f,
                                              .travel = 0.3f,
                                              .restitution = 0.9f,
                                              .seed = report.seed});
    for (const ResponseMethod method : {jacobi, coloured, warm, smallSteps, penalty}) {
        inEveryOrder(report,
                     [&] { return stateHash(afterSteps(scene, report.device, method, 2)); });
        if (report.failed()) return;
    }
}

/// Energy over energy at the start; infinite if a ball is no longer a number.
double energyKept(const Scene& scene, Device device, ResponseMethod method, int steps) {
    try {
        return kineticEnergy(afterSteps(scene, device, method, steps)) /
               kineticEnergy(scene.spheres);
    } catch (const NotFiniteError&) {
        return INFINITY;
    }
}

void requireFailsAndHolds(Report& report, const std::string& what, double fails, double holds,
                          double limit) {
    if (!(fails > limit))
        report.fail(what + ", where it should fail", brief(fails), "above " + brief(limit));
    if (!(holds < limit))
        report.fail(what + ", where it should hold", brief(holds), "below " + brief(limit));
}

void denseGas(Report& report) {
    const Scene scene =
        stability::makeGasOf({.count = 216, .volumeShare = 0.4f, .seed = report.seed});
    const auto kept = [&](ResponseMethod method) {
        return energyKept(scene, report.device, method, 80);
    };
    requireFailsAndHolds(report, "a dense elastic gas: energy / at start", kept(jacobi),
                         kept(coloured), 1.1);
    report.measured("a dense elastic gas after 80 steps, energy / at start: " +
                    ofEach({jacobi, massSplit, coloured, warm, smallSteps, penalty}, kept));
}

void columns(Report& report) {
    const auto overlap = [&](int balls) {
        return [&report, balls](ResponseMethod method) {
            const Scene scene = stability::makeColumn(balls, method == penalty ? 0.02f : 0.0f);
            return overlapInRadii(scene, afterSteps(scene, report.device, method, 180));
        };
    };
    requireFailsAndHolds(report, "a column of ten: deepest overlap / r", overlap(10)(coloured),
                         overlap(10)(smallSteps), 0.1);
    report.measured("a column of ten after 3 s, deepest overlap / r: " +
                    ofEach({jacobi, massSplit, coloured, warm, smallSteps, penalty}, overlap(10)));
}

void piles(Report& report) {
    Scene scene = stability::makeDeepPile(300, report.seed);
    const auto overlap = [&](ResponseMethod method) {
        std::fill(scene.spheres.restitutions.begin(), scene.spheres.restitutions.end(),
                  method == penalty ? 0.02f : 0.0f);
        return overlapInRadii(scene, afterSteps(scene, report.device, method, 120));
    };
    requireFailsAndHolds(report, "a pile of 300: deepest overlap / r", overlap(massSplit),
                         overlap(smallSteps), 0.2);
    report.measured("a pile of 300 after 2 s, deepest overlap / r: " +
                    ofEach({jacobi, massSplit, coloured, warm, smallSteps, penalty}, overlap));
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "11",
        {{"split.share", "The share is (1/m_a + 1/m_b) / (n_a/m_a + n_b/m_b)",
          "Each count belongs to its own ball's mass, and both balls get the same share: otherwise "
          "momentum comes from nowhere.",
          splitByHand},
         {"split.sum", "The plain sum with its shares is chapter 07's response",
          "Mass splitting is no new impulse, only less of the old one.", splitIsChapter07},
         {"split.energy", "A plain sum gains energy by a formula; with its shares it never gains",
          "A method that gains energy in one pocket blows up a gas.", plainSum},
         {"colour.hand", "At one ball the k-th pair by priority gets colour k; apart, all get 0",
          "The answer that one thread would give is the only one on which all machines agree.",
          coloursByHand},
         {"colour.round", "In one round those pairs take a colour that come first at both balls",
          "Two pairs of a ball in one round would give themselves the same colour.",
          oneColouringRound},
         {"colour.proper", "No colour has two pairs of one ball; every pair is visited once",
          "Pairs of a colour are resolved at the same time, in place. With a common ball that is "
          "chapter 07's race.",
          properColours},
         {"colour.in_order", "Rounds give the colours of one thread that goes by priority",
          "So CPU and GPU may go about it differently, and still agree.", coloursInRounds},
         {"colour.hub", "What a hub cannot colour is left over",
          "A colour must fit into the 24 bits of a ball.", hubOverflows},
         {"colour.order", "The same colours in every order of the threads",
          "Bids are minima of integers: they do not care who comes first.",
          sameColoursInEveryOrder},
         {"colour.energy", "Colour after colour, energy and momentum are those of single contacts",
          "That is what taking turns buys.", pairByPair},
         {"small.velocity", "A push of d metres in h seconds is a velocity of d / h",
          "It is the only place where a position-based step learns what it has done.",
          velocityByHand},
         {"small.bounce", "Head-on, balls leave with e times the speed they met with",
          "A push knows nothing of e. Its speed is taken back, and an impulse takes its place.",
          bounceHeadOn},
         {"small.leaving", "Balls that leave each other already go on as they do",
          "They overlap for some substeps more. An impulse would pull them back, a push hurl them.",
          leavingPairs},
         {"small.threshold", "Below the threshold nothing bounces",
          "Else what lies on the floor would hop with every substep's gravity.", slowPairsRest},
         {"small.rest", "A ball at rest on the floor stays there",
          "A method that cannot do this can do no pile.", restingBall},
         {"small.column", "A column of ten sinks less than a twentieth of a radius into itself",
          "An overlap that is left is speed in the next substep, so it cannot grow.", columnOfTen},
         {"small.reach", "One list serves a step as long as no ball leaves its reach",
          "Beyond it there may be balls that nobody looked at.", struckBeyondReach},
         {"warm.sum", "The sum of a contact's impulses does not pull, a single one may",
          "Otherwise what was too much in one pass could never be taken back.", sumsThatCannotPull},
         {"warm.column", "A column of twenty sinks less than a tenth of a radius",
          "What held it in the last step holds it in this one.", columnOfTwenty},
         {"warm.cradle", "Newton's cradle: all contacts at once converge, to the wrong answer",
          "More passes bring you nearer to the solution of the equations you wrote.", cradleAtOnce},
         {"spring.force", "In h a spring and its dashpot add h (K d - C v_n)",
          "Without h the answer depends on how finely time is cut.", forceByHand},
         {"spring.bounce", "With 20 substeps a contact, a spring meets e to 0.03",
          "The formula of C is for time without steps.", springsBounce},
         {"spring.direction", "Springs work the same in every direction",
          "A dashpot acts on the speed along the normal, which is one number, not three.",
          springsEverywhere},
         {"stability.order", "Every method: the same bits in every order of the threads",
          "An experiment that cannot be repeated shows nothing.", sameBits},
         {"stability.gas", "A dense elastic gas: the plain sum explodes, pair by pair holds",
          "It is not the step: a smaller one does not help.", denseGas},
         {"stability.column", "A column of ten: forgetting methods sink, small steps hold",
          "The floor's news travels one contact a pass, and is forgotten every step.", columns},
         {"stability.pile", "A deep pile: mass splitting sinks, small steps hold",
          "The safest method in the pocket is the worst in the pile.", piles}});
}
