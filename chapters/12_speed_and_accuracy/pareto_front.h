// Chapter 12: which points of a chart are worth having: those that no other beats in both speed and
// accuracy.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "common/hole.cuh"

namespace ballpit {

/// One run on a chart.
struct WorkPoint {
    double speed;         ///< the larger the better: a real-time factor
    double error;         ///< the smaller the better
    bool failed = false;  ///< no result, however fast it was
};

/// Has the run an error at all? One that failed has none, and NaN is none.
inline bool hasResult(const WorkPoint& point) {
    return !point.failed && !std::isnan(point.error) && !std::isnan(point.speed);
}

/// Is `a` at least as good as `b` in both, and better in one?
inline bool dominates(const WorkPoint& a, const WorkPoint& b) {
    // ---- hole front.beats (about 1 line): At least as fast and as accurate, and in one of them better
    TODO_HOLE("front.beats");
    return false;
    // ---- end of front.beats
}

/// For each point, whether it is on the Pareto front: it has a result, and no other that has one
/// dominates it. Of points that are equal, all are on it or none.
inline std::vector<bool> paretoFront(std::span<const WorkPoint> points) {
    std::vector<bool> onFront;
    for (const WorkPoint& point : points) {
        // ---- hole front.points (about 4 lines): On the front: has a result, and no other with one beats it
        TODO_HOLE("front.points");
        onFront.push_back(hasResult(point));
        // ---- end of front.points
    }
    return onFront;
}

}  // namespace ballpit
