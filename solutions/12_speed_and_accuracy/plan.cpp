// Chapter 12: how the plan is made: one decision a function.
#include "12_speed_and_accuracy/plan.h"

#include <algorithm>
#include <cmath>

#include "12_speed_and_accuracy/plan_case.h"
#include "common/error.h"

namespace ballpit {

using namespace planning;

namespace {

/// What a scene asks does not change while it runs.
Aim aimOf(const Case& c) {
    if (c.before) return c.before->aim;
    if (c.gravity() > 0) return c.facts.smallestRestitution < 1 ? Aim::rest : Aim::bounces;
    const bool thin = volumeShare(c.facts, c.world) <= c.t.thinShare;
    if (thin || c.facts.count <= 2) return Aim::meetings;
    return c.facts.smallestRestitution < 1 ? Aim::cooling : Aim::gas;
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
    plan.aim == Aim::rest ? chooseForRest(plan, c) : chooseForImpulses(plan, c);
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
