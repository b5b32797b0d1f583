// What the tests of truth/ share: tolerances that say what they are, and scenes of a few balls.
#pragma once

#include <cmath>
#include <vector>

#include "tests/catch.h"
#include "truth/balls.h"

namespace ballpit::truth {

/// Equal but for this much.
inline Approx within(double expected, double tolerance) {
    return Approx(expected).epsilon(0).margin(tolerance);
}

/// Equal but for this share of the expected value.
inline Approx withinShare(double expected, double share) {
    return within(expected, share * std::abs(expected));
}

/// A room that nothing leaves or touches in these tests.
inline Box farWalls() { return {{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}}; }

/// `count` equal balls of 1 kg and radius r, m, resting on the floor y = 0 and on one another.
inline Balls column(int count, double r, double restitution) {
    Balls balls;
    for (int k = 0; k < count; ++k) balls.push_back({{0, r + 2 * r * k, 0}, {}, r, 1, restitution});
    return balls;
}

/// Newton's cradle along x: elastic balls of 1 kg that all but touch (`gap` m apart, or overlapping
/// by -gap), the first coming with 1 m/s.
inline Balls cradle(int count, double gap) {
    Balls balls;
    for (int k = 0; k < count; ++k) balls.push_back({{k * (1 + gap), 0, 0}, {}, 0.5, 1, 1});
    balls.front().velocity.x = 1;
    return balls;
}

inline std::vector<double> speedsAlongX(const Balls& balls) {
    std::vector<double> speeds;
    for (const Ball& ball : balls) speeds.push_back(ball.velocity.x);
    return speeds;
}

/// The largest difference between two lists of equal length.
inline double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double largest = 0;
    for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
    return largest;
}

}  // namespace ballpit::truth
