// Chapter 12: how wrong a run is, as one number without units. On the host, in double precision,
// in the order given, so that the figure is the same on every machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "common/hole.cuh"

namespace ballpit {

/// sqrt(sum of d^2 / N) / r: how deep contacts are on average, with d the depth of each contact
/// (m), N the number of balls and r their mean radius (m). Divided by N and r, heaps of any size
/// and any unit can be compared; without them it is SimBenchmark's sum of squares.
inline double rmsOverlap(std::span<const double> depths, std::size_t balls, double radius) {
    // ---- hole error.overlap (about 4 lines): The formula above; 0 if there are no balls
    TODO_HOLE("error.overlap");
    return 0;
    // ---- end of error.overlap
}

/// How an energy (J) drifts from its reference: for a world with gravity the shadow energy
/// (common/metrics.h), which a step in flight leaves exactly as it is.
class EnergyDrift {
public:
    explicit EnergyDrift(double reference) : reference_(reference) {}
    void add(double energy) {
        // ---- hole error.drift (about 4 lines): Its change over |reference|; into the sums and the largest
        TODO_HOLE("error.drift");
        // ---- end of error.drift
        ++count_;
    }
    double last() const { return last_; }             ///< (E - E0) / |E0|
    double mean() const { return sum_ / divisor(); }  ///< signed: of all that was added
    double rms() const { return std::sqrt(squares_ / divisor()); }
    /// Of |E - E0| / |E0|. (A NaN is larger than nothing, but the sum has seen it.)
    double largest() const { return std::isnan(sum_) ? sum_ : largest_; }

private:
    double divisor() const { return count_ == 0 ? 1.0 : static_cast<double>(count_); }

    double reference_, sum_ = 0, squares_ = 0, last_ = 0, largest_ = 0;
    std::size_t count_ = 0;
};

}  // namespace ballpit
