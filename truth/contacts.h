// Finds who touches whom at one moment, balls and walls: brute force behind a sweep along x.
#pragma once

#include <vector>

#include "truth/balls.h"

namespace ballpit::truth {

/// One of the six walls of a box: the ball is inside while normal . x - radius >= offset.
struct Wall {
    Vector normal;  ///< unit vector inwards
    double offset;  ///< m
};
std::vector<Wall> wallsOf(const Box& box);

/// Ball b and either ball a or, if a < 0, the wall ~a.
struct Contact {
    int a, b;
};

/// All pairs of balls that overlap, in the order of (a, b), a < b.
std::vector<Contact> touchingBalls(const Balls& balls);

/// All balls that overlap a wall, and behind them all pairs of balls that overlap.
std::vector<Contact> touchingEverything(const Balls& balls, const std::vector<Wall>& walls);

/// Where a contact stands now: the unit vector from a (or out of the wall) to b, and the overlap,
/// m. Coincident centres have no direction: the ball with the smaller number then lies below.
struct Geometry {
    Vector normal;
    double penetration;
};
Geometry geometryOf(const Contact& contact, const Balls& balls, const std::vector<Wall>& walls);

/// Of two balls the smaller; against a wall, the ball's own.
double restitutionOf(const Contact& contact, const Balls& balls);

/// 1/m_a + 1/m_b, 1/kg; a wall has infinite mass.
double inverseMassSum(const Contact& contact, const Balls& balls);

/// m/s: how fast b leaves a along the normal; negative while they approach.
double separationSpeed(const Contact& contact, const Balls& balls, Vector normal);

/// An impulse (N s) along the normal on b and its opposite on a.
void applyImpulse(const Contact& contact, Balls& balls, Vector impulse);

/// Moves both apart along the normal by `push` / mass, push in kg m.
void applyPush(const Contact& contact, Balls& balls, Vector push);

}  // namespace ballpit::truth
