// Chapter 12: the plan: the least model that answers a scene's question well enough. From the facts
// of a scene to a broad phase, a cell size, a response and its knobs, and steps a frame; with the
// fact and the threshold behind each choice, what was left out, what it will cost, how wrong it
// will be.
#pragma once

#include <string>
#include <vector>

#include "10_full_system/simulator_settings.h"
#include "12_speed_and_accuracy/facts.h"

namespace ballpit {

/// What can go wrong most in such a scene, and is therefore held below the tolerance.
enum class Aim {
    rest,      ///< gravity, dull balls: how deep those at rest overlap, in mean radii
    bounces,   ///< gravity, elastic balls: the error of the energy
    gas,       ///< elastic balls that crowd: the error of the energy, the share of missed impulses
    cooling,   ///< dull balls that crowd: the error of the energy left
    meetings,  ///< few balls in much room: the angle by which each meeting turns them wrongly, rad
};
std::string name(Aim aim);

/// Where choices turn. Each number was read off runs; docs/how_it_works.md ("The plan") says which.
/// tests/test_plan.cu multiplies one by 3, or divides it, and sees a scene fail.
struct PlanThresholds {
    int naiveMost = 200;             ///< balls for which comparing all with all is no slower
    double cellsABall = 40;          ///< at most: more take longer to clear than to search
    double thinShare = 0.1;          ///< of the volume: up to it, meetings are single
    double heapShare = 0.75;         ///< rms overlap of a heap, over the column law's deepest
    double columnShare = 1.1;        ///< deepest overlap of a narrow column, over the law's
    double narrowSquares = 2.0;      ///< a narrow column stands on so many balls' squares at most
    double warmShare = 0.107;        ///< of load^2 g dt^2 / r that balls overlap under warm
    double safeOverlapSpeed = 0.3;   ///< overlap over substep that small-steps may begin with, over
                                     ///< sqrt(g r)
    double layers = 1.9;             ///< depth in balls from which bouncing balls crowd
    double bounceTravel = 0.5;       ///< radii a step of elastic balls that crowd
    double bouncePerTravel = 0.036;  ///< error of the energy of bouncing balls, a radius of travel
    double anglePerTravel = 0.424;   ///< rad (24.3 degrees) that a late contact turns, a radius
    double coolingPerTravel = 0.95;  ///< error of the energy left, a radius of rms travel
    double missedPerTravel = 0.16;   ///< share of momentum not handed on, a radius^2 of travel
    int mostContacts = 24;           ///< of a ball: so many colours there are
    double leastFloats = 4;          ///< float neighbours that a step of gravity must be long
};

struct Choice {
    std::string what, value;
    std::string because;  ///< the fact and the threshold
    std::string leftOut;  ///< what was not chosen and why; may be empty
};

struct Plan {
    Aim aim = Aim::rest;
    double tolerance = 0;
    int stepsAFrame = 1;
    BroadPhaseMethod broadPhase = BroadPhaseMethod::grid;
    float cellSize = 0;  ///< m
    ResponseMethod response = ResponseMethod::coloured;
    ResponseKnobs knobs;
    std::vector<Choice> choices;
    std::vector<std::string> warnings;
    double predictedError = 0;                ///< in the tolerance's unit
    double pairVisits = 0, milliseconds = 0;  ///< predicted, a simulated second, one core of a CPU

    bool meetsTolerance() const { return predictedError <= tolerance; }
};

/// The tolerance where nobody says another, as for a deep pile: 5 % of a radius, of the energy, of
/// a radian.
constexpr double usualTolerance = 0.05;

/// `before`: the plan in force, if there is one: a choice is then changed only if it is clearly
/// wrong, so that a scene on a threshold does not go to and fro. A plan is always made; if nothing
/// meets the tolerance, it is the best there is.
Plan makePlan(const SceneFacts& facts, const World& world, double tolerance,
              const PlanThresholds& thresholds = {}, const Plan* before = nullptr);

/// InputError, saying what is the best within reach and its cost, unless the plan meets its
/// tolerance.
void requireMet(const Plan& plan);

/// "small-steps, 2 substeps, grid of 1.8 m, 1 step a frame": the settings, without reasons.
std::string inShort(const Plan& plan);

/// The same of a simulator's completed settings, without a plan.
std::string inShort(const SimulatorSettings& settings);

/// The settings of a simulator that follows the plan.
SimulatorSettings planned(SimulatorSettings settings, const Plan& plan, const World& world);

/// Do both ask for the same settings?
bool sameSettings(const Plan& a, const Plan& b);

}  // namespace ballpit
