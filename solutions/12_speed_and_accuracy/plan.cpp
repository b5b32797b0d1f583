// Chapter 12: how the plan is made: one decision a function.
#include "12_speed_and_accuracy/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "12_speed_and_accuracy/parts.h"
#include "common/error.h"

namespace ballpit {

namespace {

constexpr int mostSteps = 64;      // a frame
constexpr int mostSubsteps = 100;  // a frame
constexpr int mostPasses = 100;
constexpr double pi = 3.14159265358979;

template <class... Values>
std::string format(const char* pattern, Values... values) {
    char text[240];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

std::string counted(int count, const char* thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

/// What all decisions look at.
struct Case {
    const SceneFacts& facts;
    const World& world;
    const PlanThresholds& t;
    double tolerance;
    const Plan* before;

    double gravity() const { return length(world.gravity); }
    /// Radii of the smallest ball that the fastest makes in a frame, and the usual one.
    double travel(double speed) const {
        return facts.smallestRadius > 0 ? speed * world.frame / facts.smallestRadius : 0;
    }
};

/// What a scene asks does not change while it runs.
Aim aimOf(const Case& c) {
    if (c.before) return c.before->aim;
    if (c.gravity() > 0) return c.facts.smallestRestitution < 1 ? Aim::rest : Aim::bounces;
    const bool thin = volumeShare(c.facts, c.world) <= c.t.thinShare;
    if (thin || c.facts.count <= 2) return Aim::meetings;
    return c.facts.smallestRestitution < 1 ? Aim::cooling : Aim::gas;
}

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

void choose(Plan& plan, std::string what, std::string value, std::string because,
            std::string leftOut = "") {
    plan.choices.push_back(
        {std::move(what), std::move(value), std::move(because), std::move(leftOut)});
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

/// Rounds of impulses, a pair after the other: energy stays, whatever the density.
void chooseImpulses(Plan& plan, const Case& c) {
    const bool were = c.before && c.before->response == ResponseMethod::massSplit;
    const int most = were ? c.t.mostContacts / 2 : c.t.mostContacts;
    const bool hubs = static_cast<int>(c.facts.mostContacts) > most;
    plan.response = hubs ? ResponseMethod::massSplit : ResponseMethod::coloured;
    plan.knobs.iterations = 1;
    if (!hubs) plan.knobs.restitutionThreshold = 0.0f;
    const std::string contacts = format("a ball touches up to %u others now; colours: %d",
                                        c.facts.mostContacts, c.t.mostContacts);
    if (hubs)
        choose(plan, "response", "mass-split",
               contacts + ": more than there are colours; it never gains energy",
               "coloured: one thread would resolve what has no colour");
    else
        choose(
            plan, "response", "coloured",
            contacts + "; each impulse keeps energy and momentum at any density",
            "jacobi: the same visits and the same time, and energy from nowhere once a ball meets "
            "two at once; mass-split: loses more than a tenth; warm: fails Newton's cradle; "
            "small-steps: three times the visits for the same energy");
    choose(plan, "passes", "1", "a second round finds hardly a pair that still approaches",
           hubs ? "" : "restitution threshold: 0, since nothing comes to rest");
}

int stepsNow(const Case& c) { return c.before ? c.before->stepsAFrame : 0; }

constexpr const char* momentsOfContact =
    "finding the moment of contact within a step (continuous detection): not in the engine, "
    "smaller "
    "steps meet the tolerance of all charted scenes";

void chooseSteps(Plan& plan, const Case& c, double travel, double limit, const char* rule) {
    plan.stepsAFrame = partsFor(travel, limit, mostSteps, stepsNow(c));
    choose(plan, "steps a frame", std::to_string(plan.stepsAFrame),
           format("the fastest moves %.3g r a frame; limit %.3g r a step: ", travel, limit) + rule,
           momentsOfContact);
}

/// How far may balls move between two looks, so that no more than the tolerance is missed?
double travelForMissed(const Case& c) { return std::sqrt(c.tolerance / c.t.missedPerTravel); }

/// Contacts that are found late, and so pushed apart, change the energy a little: of balls that
/// crowd, to more and more.
void chooseStepsForBounces(Plan& plan, const Case& c) {
    const double travel = c.travel(c.facts.speedToCome), depth = depthInBalls(c.facts, c.world);
    const bool crowded = depth >= c.t.layers;
    const double limit = c.tolerance / c.t.bouncePerTravel;
    plan.stepsAFrame = partsFor(travel, crowded ? std::min(limit, c.t.bounceTravel) : limit,
                                mostSteps, stepsNow(c));
    choose(
        plan, "steps a frame", std::to_string(plan.stepsAFrame),
        format("the fastest to come moves %.3g r a frame; limit %.3g r a step, and %.3g r if balls "
               "crowd, %.3g of them deep or more: here %.3g",
               travel, limit, c.t.bounceTravel, c.t.layers, depth),
        momentsOfContact);
    constexpr double ofCrowds = 0.04;  // of 666, e = 1: no number of steps made it smaller
    plan.predictedError =
        std::max(crowded ? ofCrowds : 0, c.t.bouncePerTravel * travel / plan.stepsAFrame);
}

void chooseStepsForGas(Plan& plan, const Case& c) {
    const double travel = c.travel(c.facts.largestSpeed);
    chooseSteps(plan, c, travel, travelForMissed(c),
                "beyond, more than the tolerance is handed on wrongly, as travel^2");
    plan.predictedError = c.t.missedPerTravel * std::pow(travel / plan.stepsAFrame, 2.0);
}

void chooseStepsForCooling(Plan& plan, const Case& c) {
    const double travel = c.travel(c.facts.rmsSpeed);
    chooseSteps(plan, c, travel, c.tolerance / c.t.coolingPerTravel,
                "that is the rms speed; collisions that come late cool too slowly (gas map)");
    plan.predictedError = c.t.coolingPerTravel * travel / plan.stepsAFrame;
}

void chooseStepsForMeetings(Plan& plan, const Case& c) {
    const double travel = c.travel(c.facts.largestSpeed);
    chooseSteps(plan, c, travel, c.tolerance / c.t.anglePerTravel,
                "a contact found late turns the balls wrongly by 24.3 degrees a radius");
    plan.predictedError = c.t.anglePerTravel * travel / plan.stepsAFrame;
}

void chooseResponseAndSteps(Plan& plan, const Case& c) {
    if (plan.aim == Aim::rest) return chooseForRest(plan, c);
    chooseImpulses(plan, c);
    if (plan.aim == Aim::bounces) return chooseStepsForBounces(plan, c);
    if (plan.aim == Aim::cooling) return chooseStepsForCooling(plan, c);
    if (plan.aim == Aim::meetings) return chooseStepsForMeetings(plan, c);
    chooseStepsForGas(plan, c);
}

void chooseBroadPhase(Plan& plan, const Case& c) {
    if (c.world.periodic) return choose(plan, "broad phase", "grid", "the box is periodic");
    const bool naive = c.facts.count <= c.t.naiveMost;
    plan.broadPhase = naive ? BroadPhaseMethod::naive : BroadPhaseMethod::grid;
    choose(plan, "broad phase", naive ? "naive" : "grid",
           format("%s, limit %d", counted(c.facts.count, "ball").c_str(), c.t.naiveMost),
           naive ? "grid: sorting costs more than comparing so few"
                 : "naive: time grows with the square of the balls");
}

/// m: a periodic box needs three cells and a hair along every edge.
double largestCell(const World& world) {
    const Vec3 size = extent(world.walls);
    const float shortest = minimum(size.x, minimum(size.y, size.z));
    return world.periodic ? shortest / 3.2 : shortest;
}

/// As small as the largest ball, unless there would be too many cells.
void chooseCells(Plan& plan, const Case& c) {
    plan.cellSize = c.world.cellSize;
    if (plan.broadPhase == BroadPhaseMethod::naive) return;
    const Vec3 size = extent(c.world.walls);
    const double fewest = std::min(
        largestCell(c.world), std::cbrt(double(size.x) * size.y * size.z /
                                        (c.t.cellsABall * static_cast<double>(c.facts.count))));
    const float diameter = 2.0f * c.facts.largestRadius;
    const bool sparse = fewest > double(diameter);
    plan.cellSize = sparse ? static_cast<float>(fewest) : diameter;
    const double spread = c.facts.largestRadius / std::max(c.facts.smallestRadius, 1e-9f);
    choose(plan, "cell size", format("%.4g m", double(plan.cellSize)),
           sparse ? format("%.3g cells a ball", c.t.cellsABall) +
                        ": more take longer to clear than to search"
                  : format("the largest diameter (more where balls reach beyond themselves, in "
                           "substeps); radii spread %.3g fold",
                           spread),
           "a grid for each size of ball (it would pay beyond a spread of 3): not in the engine");
}

/// Floats have 24 digits: far from the origin, small motions round to nothing.
void choosePrecision(Plan& plan, const Case& c) {
    const double parts = double(plan.stepsAFrame) * plan.knobs.substeps.value_or(1);
    const double floats = floatsPerStep(c.facts, c.world, c.world.frame / parts);
    const bool enough = floats >= c.t.leastFloats || floats == 0;
    choose(
        plan, "precision", "float",
        format("a step at the start is %.3g floats long at %.4g m from the origin; at least %.3g",
               floats, farthestCoordinate(c.world), c.t.leastFloats),
        "double: not in the engine, no charted scene needs it");
    const double least = farthestCoordinate(c.world) * 0x1p-23 / c.world.meanRadius;
    plan.predictedError = std::max(plan.predictedError, least);
    if (!enough)
        plan.warnings.push_back(
            format("floats are too coarse %.4g m from the origin: what gravity moves in a step is "
                   "%.2g of them, and rounds to nothing or to one; move the world to the origin",
                   farthestCoordinate(c.world), floats));
}

// What it will cost.

/// us of one core for a ball a step, for a ball a substep, and for a visited pair. Read off 666,
/// the deep pile and the gas on one core of a 2.x GHz Xeon: good to a factor of 2 elsewhere.
constexpr double ballStep = 0.3, ballSubstep = 0.05;
double visitTime(ResponseMethod method) {
    switch (method) {
        case ResponseMethod::smallSteps:
            return 0.19;
        case ResponseMethod::warm:
            return 0.3;
        default:
            return 0.12;
    }
}

/// Collisions of hard balls a second and ball, by Enskog: 12 share g v / (pi^0.5 r) with the
/// contact value g of Carnahan and Starling and the thermal speed v.
double collisionRate(const Case& c) {
    const double share = std::min(0.6, volumeShare(c.facts, c.world));
    const double contactValue = (1 - share / 2) / std::pow(1 - share, 3);
    const double speed = c.facts.rmsSpeed / std::sqrt(3.0);
    return 12 * share * contactValue * speed / std::sqrt(pi) / std::max(c.world.meanRadius, 1e-9);
}

/// Pairs that a look will list, once the scene has become what it tends to.
double pairsToCome(const Case& c, const Plan& plan) {
    constexpr double inAHeap = 3.3, amongBouncing = 0.5;  // a ball, measured in the scenes 666
    const double depth = std::min(1.0, depthInBalls(c.facts, c.world));
    const double looks = plan.stepsAFrame / double(c.world.frame);
    const double balls = c.facts.count;
    if (plan.aim == Aim::rest) return balls * inAHeap * depth;
    if (plan.aim == Aim::bounces) return balls * amongBouncing * depth;
    return std::max(double(c.facts.pairs), 0.5 * balls * collisionRate(c) / looks);
}

void predictCost(Plan& plan, const Case& c) {
    const double steps = plan.stepsAFrame / double(c.world.frame);
    const double substeps = plan.knobs.substeps.value_or(1);
    const double visitsAStep = pairsToCome(c, plan) * substeps * plan.knobs.iterations.value_or(1);
    plan.pairVisits = visitsAStep * steps;
    plan.milliseconds = 1e-3 * (steps * c.facts.count * (ballStep + substeps * ballSubstep) +
                                plan.pairVisits * visitTime(plan.response));
}

}  // namespace

std::string name(Aim aim) {
    switch (aim) {
        case Aim::rest:
            return "overlap of balls at rest, in radii";
        case Aim::bounces:
            return "energy of bouncing balls";
        case Aim::gas:
            return "energy of a gas, and impulses not missed";
        case Aim::cooling:
            return "energy of a gas that cools";
        case Aim::meetings:
            return "angles of single meetings, in radians";
    }
    throw std::logic_error("an aim without a name");
}

Plan makePlan(const SceneFacts& facts, const World& world, double tolerance,
              const PlanThresholds& thresholds, const Plan* before) {
    const Case c{facts, world, thresholds, tolerance, before};
    Plan plan;
    plan.aim = aimOf(c);
    plan.tolerance = tolerance;
    chooseResponseAndSteps(plan, c);
    chooseBroadPhase(plan, c);
    chooseCells(plan, c);
    choosePrecision(plan, c);
    predictCost(plan, c);
    return plan;
}

void requireMet(const Plan& plan) {
    if (plan.meetsTolerance()) return;
    throw InputError(format("tolerance %.3g: the best within reach is %.2g (%s), with ",
                            plan.tolerance, plan.predictedError, name(plan.aim).c_str()) +
                     inShort(plan) +
                     format(", at %.3g pair visits and about %.3g ms a simulated second",
                            plan.pairVisits, plan.milliseconds));
}

std::string inShort(const SimulatorSettings& s) {
    std::string text = name(s.response);
    if (s.substeps.value_or(1) > 1 || s.response == ResponseMethod::smallSteps)
        text += ", " + counted(s.substeps.value_or(1), "substep");
    if (s.iterations.value_or(1) > 1) text += ", " + std::to_string(*s.iterations) + " passes";
    return text + (s.broadPhase == BroadPhaseMethod::naive
                       ? ", all pairs"
                       : format(", cells of %.4g m", double(s.cellSize)));
}

std::string inShort(const Plan& plan) {
    return inShort(planned({}, plan, {})) + ", " + counted(plan.stepsAFrame, "step") + " a frame";
}

SimulatorSettings planned(SimulatorSettings settings, const Plan& plan, const World& world) {
    settings.dt = world.frame / static_cast<float>(plan.stepsAFrame);
    settings.broadPhase = plan.broadPhase;
    settings.cellSize = plan.cellSize;
    settings.response = plan.response;
    static_cast<ResponseKnobs&>(settings) = plan.knobs;
    return settings;
}

bool sameSettings(const Plan& a, const Plan& b) {
    return a.stepsAFrame == b.stepsAFrame && a.broadPhase == b.broadPhase &&
           a.cellSize == b.cellSize && a.response == b.response &&
           a.knobs.iterations == b.knobs.iterations && a.knobs.substeps == b.knobs.substeps;
}

}  // namespace ballpit
