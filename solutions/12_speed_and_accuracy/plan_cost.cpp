// Chapter 12: what a plan will cost, in pair visits and in time.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "12_speed_and_accuracy/plan_case.h"

namespace ballpit::planning {

namespace {

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
    return 12 * share * contactValue * speed / std::sqrt(std::numbers::pi) /
           std::max(c.world.meanRadius, 1e-9);
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

}  // namespace

void predictCost(Plan& plan, const Case& c) {
    const double steps = plan.stepsAFrame / double(c.world.frame);
    const double substeps = plan.knobs.substeps.value_or(1);
    const double visitsAStep = pairsToCome(c, plan) * substeps * plan.knobs.iterations.value_or(1);
    plan.pairVisits = visitsAStep * steps;
    plan.milliseconds = 1e-3 * (steps * c.facts.count * (ballStep + substeps * ballSubstep) +
                                plan.pairVisits * visitTime(plan.response));
}

}  // namespace ballpit::planning
