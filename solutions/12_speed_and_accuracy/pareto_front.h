// Chapter 12: which points of a chart are worth having: those that no other beats in both speed and
// accuracy.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace ballpit {

/// One run on a chart.
struct WorkPoint {
    double speed;         ///< the larger the better: a real-time factor
    double error;         ///< the smaller the better
    bool failed = false;  ///< no result, however fast it was
};

/// Is `a` at least as good as `b` in both, and better in one?
inline bool dominates(const WorkPoint& a, const WorkPoint& b) {
    return a.speed >= b.speed && a.error <= b.error && (a.speed > b.speed || a.error < b.error);
}

/// For each point, whether it is on the Pareto front: it has not failed, and no other that has not
/// failed dominates it. Of points that are equal, all are on it or none.
inline std::vector<bool> paretoFront(std::span<const WorkPoint> points) {
    std::vector<bool> onFront;
    for (const WorkPoint& point : points)
        onFront.push_back(!point.failed &&
                          std::none_of(points.begin(), points.end(), [&](const WorkPoint& other) {
                              return !other.failed && dominates(other, point);
                          }));
    return onFront;
}

}  // namespace ballpit
