// Chapter 12: the plan for balls that bounce, in a gas or on a floor: impulses, and steps that are
// small enough for how fast they fly.
#include <algorithm>
#include <cmath>

#include "12_speed_and_accuracy/parts.h"
#include "12_speed_and_accuracy/plan_case.h"

namespace ballpit::planning {

namespace {

constexpr int mostSteps = 64;  // a frame

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

}  // namespace

void chooseForImpulses(Plan& plan, const Case& c) {
    chooseImpulses(plan, c);
    if (plan.aim == Aim::bounces) return chooseStepsForBounces(plan, c);
    if (plan.aim == Aim::cooling) return chooseStepsForCooling(plan, c);
    if (plan.aim == Aim::meetings) return chooseStepsForMeetings(plan, c);
    chooseStepsForGas(plan, c);
}

}  // namespace ballpit::planning
