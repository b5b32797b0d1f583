// Chapter 12: what a scene is like, in numbers: what a plan is made from.
#pragma once

#include <cstdint>

#include "common/scene.h"

namespace ballpit {

/// What stays the same during a run.
struct World {
    Bounds walls;       ///< m
    Vec3 gravity;       ///< m/s^2
    float damping;      ///< 1/s
    float frame;        ///< s: the time between two pictures, or two readings of the state
    float cellSize;     ///< m: what the scene asks for
    double ballVolume;  ///< m^3, of all balls
    double ballMass;    ///< kg, of all balls
    double meanRadius;  ///< m
    bool periodic;      ///< no walls: what leaves on one side comes in on the other
};

/// The scene's world. Sums over the balls are made here, once: in double precision, in body order.
World worldOf(const Scene& scene);

/// The state of the balls at one moment.
struct SceneFacts {
    int count = 0;
    float smallestRadius = 0, largestRadius = 0;  ///< m
    float largestSpeed = 0, rmsSpeed = 0;         ///< m/s
    float speedToCome = 0;  ///< m/s: the largest that any ball has on arriving at a wall below it
    float smallestRestitution = 0, largestRestitution = 0;  ///< 0 to 1
    float smallestMass = 0, largestMass = 0;                ///< kg
    Bounds span{};                                          ///< m: a box around all balls
    std::uint32_t pairs = 0;                                ///< touching ones
    std::uint32_t mostContacts = 0;                         ///< of one ball
    float massRatio = 1;       ///< the largest of two balls that touch; 1 if none do
    float deepestOverlap = 0;  ///< of two balls, in radii of the smaller
};

// What follows from them.

/// The share of the box around the balls, as far as it lies within the walls, that is ball.
double volumeShare(const SceneFacts& facts, const World& world);

/// m^2: what the balls cover, seen along gravity (the axis in which it is strongest).
double floorCovered(const SceneFacts& facts, const World& world);

/// How high the balls would lie, in balls, if they were heaped on the floor below where they are:
/// a heap of balls at random is 0.6 ball. 0 without gravity.
double depthInBalls(const SceneFacts& facts, const World& world);

/// How many times its own weight the lightest ball carries at the bottom of that heap: the weight
/// of all others on the floor they lie on, times the square that the ball takes up.
double loadOnLightest(const SceneFacts& facts, const World& world);

/// The largest coordinate of the walls, m, and how many floats lie between two places that gravity
/// (or, without it, the fastest ball) brings one another's way in a step of dt s.
double farthestCoordinate(const World& world);
double floatsPerStep(const SceneFacts& facts, const World& world, double dt);

}  // namespace ballpit
