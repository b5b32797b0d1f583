// Closed forms and laws of resting contacts: a column of balls on the floor, heavy on light, and how
// many pairs can touch at all.
#pragma once

#include <cmath>
#include <numbers>

namespace ballpit::truth {

/// Upper bounds for the number of touching pairs of `count` balls that do not overlap. Equal balls
/// touch 12 others at most, and each pair counts for two. Of different balls, charge each pair to the
/// smaller one: at most 12 others not smaller than itself can touch it (the kissing number).
inline double mostPairsOfEqualBalls(double count) { return 6 * count; }
inline double mostPairsOfAnyBalls(double count) { return 12 * count; }

/// By which factor a Gauss-Seidel pass shrinks the error of the impulses in a column of n equal balls
/// on a floor: cos^2(pi / 2n). The Jacobi matrix has the zeros of Chebyshev's T_n as eigenvalues, and
/// Gauss-Seidel's are their squares.
inline double columnRate(int n) {
    const double jacobi = std::cos(std::numbers::pi / (2 * n));
    return jacobi * jacobi;
}

/// The same for a ball of `ratio` times the mass on a light one on the floor: R / (1 + R).
inline double heavyOnLightRate(double ratio) { return ratio / (1 + ratio); }

/// Passes that bring the error down to a tenth.
inline double passesPerDecade(double rate) { return std::log(10.0) / -std::log(rate); }

/// The impulse in a resting column's contact with k balls above it, N s a step: k m g dt.
inline double columnLoad(int k, double m, double g, double dt) { return k * m * g * dt; }

}  // namespace ballpit::truth
