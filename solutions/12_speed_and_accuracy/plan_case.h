// Chapter 12: what all decisions of the plan look at, and how one is noted. Internal to the plan.
#pragma once

#include <cstdio>
#include <string>
#include <utility>

#include "12_speed_and_accuracy/plan.h"

namespace ballpit::planning {

template <class... Values>
std::string format(const char* pattern, Values... values) {
    char text[240];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

inline std::string counted(int count, const char* thing) {
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

/// Notes a choice down.
inline void choose(Plan& plan, std::string what, std::string value, std::string because,
                   std::string leftOut = "") {
    plan.choices.push_back(
        {std::move(what), std::move(value), std::move(because), std::move(leftOut)});
}

// The decisions that have a file of their own.

/// Balls come to rest on each other: small-steps, or warm, and with how many parts (plan_rest.cpp).
void chooseForRest(Plan& plan, const Case& c);

/// Rounds of impulses, and steps a frame as the aim asks for (plan_impulses.cpp).
void chooseForImpulses(Plan& plan, const Case& c);

/// What the plan will cost (plan_cost.cpp).
void predictCost(Plan& plan, const Case& c);

}  // namespace ballpit::planning
