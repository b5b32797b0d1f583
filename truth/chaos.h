// How long two computations of one gas stay comparable: a tiny difference grows with each
// collision.
#pragma once

#include <cmath>

namespace ballpit::truth {

// The difference of two runs of an elastic gas grows by exp(growth) for each collision of a ball.
// Measured here, +-20 % (tests/test_truth_gas.cpp), at two shares of volume: in a denser gas a ball
// flies less far between collisions, so each turns it aside less.
inline constexpr double growthDilute = 1.7;  ///< share of volume 0.105
inline constexpr double growthDense = 0.8;   ///< share of volume 0.262

/// Collisions a ball may have before runs that differ by `difference` (in diameters, rms: 1e-7 for
/// floats, 1e-16 for doubles, 1e-12 for another order of sums) differ by more than `allowed`. After
/// that only statistics can be compared.
inline double comparableCollisions(double difference, double allowed, double growth) {
    return std::log(allowed / difference) / growth;
}

}  // namespace ballpit::truth
