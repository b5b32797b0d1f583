// Closed forms and laws of resting contacts: a column of balls on the floor, heavy on light, and
// how many pairs can touch at all.
#pragma once

#include <cmath>
#include <numbers>

namespace ballpit::truth {

/// Upper bounds for the number of touching pairs of `count` balls that do not overlap. Equal balls
/// touch 12 others at most, and each pair counts for two. Of different balls, charge each pair to
/// the smaller one: at most 12 others not smaller than itself can touch it (the kissing number).
inline double mostPairsOfEqualBalls(double count) { return 6 * count; }
inline double mostPairsOfAnyBalls(double count) { return 12 * count; }

/// By which factor a Gauss-Seidel pass shrinks the error of the impulses in a column of n equal
/// balls on a floor: cos^2(pi / 2n). The Jacobi matrix has the zeros of Chebyshev's T_n as
/// eigenvalues, and Gauss-Seidel's are their squares.
inline double columnRate(int n) {
    const double jacobi = std::cos(std::numbers::pi / (2 * n));
    return jacobi * jacobi;
}

/// The same for a ball of `ratio` times the mass on a light one on the floor: R / (1 + R).
inline double heavyOnLightRate(double ratio) { return ratio / (1 + ratio); }

/// Passes that bring the error down to a tenth.
inline double passesPerDecade(double rate) { return std::log(10.0) / -std::log(rate); }

/// The impulse in a resting column's contact that carries k balls, N s a step: k m g dt.
inline double columnLoad(int k, double m, double g, double dt) { return k * m * g * dt; }

// The column law: a column of n equal, inelastic balls, resolved pair by pair and pass by pass with
// nothing remembered, stays pressed together by about
//     C n^3 g tau^2      tau = dt / passes, s: the time from one pass to the next
// since gravity adds g tau to each ball between passes while news of the floor spreads only one
// contact a pass in one order, and thins out in the other. The floor must act in every pass. C
// depends on the order of the contacts; these are this project's measurements
// (tests/test_truth_columns.cpp) of the deepest overlap after a step, averaged over time, for 10 to
// 40 balls, +-30 %.
inline constexpr double columnFromBelow = 0.6;   ///< contacts in the order floor to top
inline constexpr double columnFromAbove = 1.45;  ///< top to floor
inline constexpr double columnShuffled = 1.75;   ///< in another random order each pass

/// m.
inline double columnOverlap(double C, int n, double g, double tau) {
    return C * n * n * n * g * tau * tau;
}

/// The tallest column, in balls, whose overlap stays below `allowed` m.
inline double tallestColumn(double C, double allowed, double g, double tau) {
    return std::cbrt(allowed / (C * g * tau * tau));
}

/// How deep the lowest of n balls stays in the floor, m, if the floor acts only once a step: with
/// any number of passes between the balls, n (n - 1) g dt^2. The floor stops the lowest ball alone;
/// the passes share that out and leave all balls (n - 1) / n of the speed they had. So they settle
/// at (n - 1) g dt downwards, sink n g dt^2 a step, and the floor, which lifts only one ball in n,
/// must lift it n^2 g dt^2, of which all but the n-th part is lost to the others.
inline double columnOverlapFloorOnce(int n, double g, double dt) {
    return n * (n - 1.0) * g * dt * dt;
}

}  // namespace ballpit::truth
