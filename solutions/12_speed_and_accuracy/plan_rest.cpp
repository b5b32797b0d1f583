// Chapter 12: the plan for balls that come to rest on each other.
#include <algorithm>
#include <cmath>

#include "12_speed_and_accuracy/parts.h"
#include "12_speed_and_accuracy/plan_case.h"

namespace ballpit::planning {

namespace {

constexpr int mostSubsteps = 100;  // a frame
constexpr int mostPasses = 100;

// Balls at rest on each other: by how much they overlap. In a substep h of position-based steps, a
// contact below the load of n balls' weight keeps n g h^2 (1 / m_above + 1 / m_below) m: the push
// that lifts the load against what it falls in h.

/// In mean radii, at the bottom, of one substep a frame.
double columnLaw(const Case& c) {
    const double fall = c.gravity() * double(c.world.frame) * c.world.frame;
    const double inverse = 1 + double(c.facts.smallestMass) / c.facts.largestMass;
    return loadOnLightest(c.facts, c.world) * fall * inverse / c.world.meanRadius;
}

bool isNarrow(const Case& c) {
    const double square = 4.0 * c.facts.smallestRadius * c.facts.smallestRadius;
    return floorCovered(c.facts, c.world) <= c.t.narrowSquares * square;
}

double restShare(const Case& c) { return isNarrow(c) ? c.t.columnShare : c.t.heapShare; }

int substepsForLoad(const Case& c, int now) {
    return substepsFor(restShare(c) * columnLaw(c), c.tolerance, mostSubsteps, now);
}

/// Overlap of a column whose impulses start from the last step's, in radii, after so many passes.
double warmColumn(const Case& c, int passes) {
    const double load = loadOnLightest(c.facts, c.world);
    const double fall = c.gravity() * double(c.world.frame) * c.world.frame / c.world.meanRadius;
    return c.t.warmShare * load * load * fall / std::pow(passes, 1.2);
}

int warmPasses(const Case& c) {
    int passes = 1;
    while (passes < mostPasses && warmColumn(c, passes) > c.tolerance) ++passes;
    return passes;
}

/// Overlaps become speed under small-steps. How deep may balls be in each other when it begins, in
/// radii? So that they part with a share of sqrt(g r); or, if they lay still under another
/// response, as their load presses them anyway.
double safeOverlap(const Case& c, int substeps) {
    const double h = double(c.world.frame) / substeps, r = c.facts.smallestRadius;
    const double slow = c.t.safeOverlapSpeed * std::sqrt(c.gravity() * r) * h / r;
    return c.before ? std::max(slow, columnLaw(c) / (substeps * substeps)) : slow;
}

int substepsNow(const Case& c) {
    return c.before && c.before->response == ResponseMethod::smallSteps
               ? c.before->knobs.substeps.value_or(0)
               : 0;
}

void chooseSmallSteps(Plan& plan, const Case& c) {
    const int substeps = substepsForLoad(c, substepsNow(c));
    plan.response = ResponseMethod::smallSteps;
    plan.knobs.iterations = 1;
    plan.knobs.substeps = substeps;
    plan.predictedError = restShare(c) * columnLaw(c) / (double(substeps) * substeps);
    choose(plan, "response", "small-steps",
           format("gravity, and restitution from %.3g: balls come to rest on each other",
                  double(c.facts.smallestRestitution)),
           "mass-split, jacobi, coloured: a heap sinks under them; warm: half the error for twice "
           "the passes, where twice the substeps leave a quarter");
    choose(
        plan, "substeps", std::to_string(substeps),
        format("a load of %.3g balls on the lowest presses it %.3g r deep / substeps^2; %.2g of "
               "that, rms; tolerance %.3g",
               loadOnLightest(c.facts, c.world), columnLaw(c), restShare(c), c.tolerance),
        "more of them for fast balls: whatever the speed, a heap comes to rest as its load says; "
        "more passes in each: as much work, less gain");
}

void chooseWarm(Plan& plan, const Case& c, const std::string& because, const std::string& leftOut) {
    plan.response = ResponseMethod::warm;
    plan.knobs.iterations = warmPasses(c);
    plan.predictedError = warmColumn(c, *plan.knobs.iterations);
    choose(plan, "response", "warm", because, leftOut);
    choose(plan, "passes", std::to_string(*plan.knobs.iterations),
           format("load %.3g balls: %.3g r at 1 pass, falling with passes^1.2; tolerance %.3g",
                  loadOnLightest(c.facts, c.world), warmColumn(c, 1), c.tolerance));
}

/// Passes that remember, or substeps, for a column that nothing holds from the side? What visits
/// fewer pairs.
bool warmIsCheaper(const Case& c) {
    return isNarrow(c) && c.facts.largestRestitution == 0 && warmPasses(c) < substepsForLoad(c, 0);
}

bool startsTooDeep(const Case& c) {
    return c.facts.deepestOverlap > safeOverlap(c, substepsForLoad(c, 0));
}

}  // namespace

/// Once small-steps runs, it stays: what overlaps then is of its own making.
void chooseForRest(Plan& plan, const Case& c) {
    if (substepsNow(c) > 0) return chooseSmallSteps(plan, c);
    if (startsTooDeep(c))
        return chooseWarm(
            plan, c,
            format("balls overlap by up to %.3g r now; small-steps can begin with %.3g r",
                   double(c.facts.deepestOverlap), safeOverlap(c, substepsForLoad(c, 0))),
            "small-steps, until that is over: overlaps become speed there");
    if (warmIsCheaper(c))
        return chooseWarm(
            plan, c,
            format("a narrow column of dull balls, on %.3g of a ball's squares (up to "
                   "%.3g): as good as %d substeps",
                   floorCovered(c.facts, c.world) /
                       (4.0 * c.facts.smallestRadius * c.facts.smallestRadius),
                   c.t.narrowSquares, substepsForLoad(c, 0)),
            "small-steps: visits more pairs for the same");
    chooseSmallSteps(plan, c);
}

}  // namespace ballpit::planning
