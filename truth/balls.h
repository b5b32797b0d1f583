// Balls in double precision, what a collision does to two of them, and their sums: energy,
// momentum.
#pragma once

#include <algorithm>
#include <vector>

#include "truth/vector.h"

namespace ballpit::truth {

struct Ball {
    Vector position;         ///< m
    Vector velocity;         ///< m/s
    double radius = 0.5;     ///< m
    double mass = 1;         ///< kg
    double restitution = 1;  ///< 0 dead to 1 elastic
};
using Balls = std::vector<Ball>;

/// The duller of two balls decides how they bounce.
inline double combinedRestitution(const Ball& a, const Ball& b) {
    return std::min(a.restitution, b.restitution);
}

/// m_eff = 1 / (1/m_a + 1/m_b), kg.
inline double effectiveMass(double a, double b) { return 1 / (1 / a + 1 / b); }

/// How fast b leaves a along the unit vector `normal` from a to b, m/s: negative while they
/// approach.
inline double separationSpeed(const Ball& a, const Ball& b, Vector normal) {
    return dot(b.velocity - a.velocity, normal);
}

/// The impulse J = -(1 + e) v_n m_eff on b along `normal`, its opposite on a. Returns J, N s.
inline double collide(Ball& a, Ball& b, Vector normal, double restitution) {
    const double impulse =
        -(1 + restitution) * separationSpeed(a, b, normal) * effectiveMass(a.mass, b.mass);
    a.velocity -= (impulse / a.mass) * normal;
    b.velocity += (impulse / b.mass) * normal;
    return impulse;
}

/// Sum of m v^2 / 2, J.
inline double kineticEnergy(const Balls& balls) {
    double sum = 0;
    for (const Ball& ball : balls) sum += 0.5 * ball.mass * dot(ball.velocity, ball.velocity);
    return sum;
}

/// Sum of -m g . x, J, for the acceleration `gravity`, m/s^2.
inline double potentialEnergy(const Balls& balls, Vector gravity) {
    double sum = 0;
    for (const Ball& ball : balls) sum -= ball.mass * dot(gravity, ball.position);
    return sum;
}

/// Sum of m v, kg m/s.
inline Vector momentum(const Balls& balls) {
    Vector sum;
    for (const Ball& ball : balls) sum += ball.mass * ball.velocity;
    return sum;
}

/// Granular temperature T, J: a third of m v^2 a ball (Boltzmann's constant is 1).
inline double temperature(const Balls& balls) {
    return 2 * kineticEnergy(balls) / (3 * static_cast<double>(balls.size()));
}

/// The deepest overlap of any two balls, m; 0 if none touch. Compares every two.
inline double deepestOverlap(const Balls& balls) {
    double deepest = 0;
    for (std::size_t a = 0; a < balls.size(); ++a)
        for (std::size_t b = a + 1; b < balls.size(); ++b)
            deepest = std::max(deepest, balls[a].radius + balls[b].radius -
                                            length(balls[b].position - balls[a].position));
    return deepest;
}

}  // namespace ballpit::truth
