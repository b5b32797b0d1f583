// The lesson's worked example: eight runs, and which of them are on the front.
#pragma once

#include <vector>

#include "12_speed_and_accuracy/pareto_front.h"

namespace ballpit {

struct ExamplePoint {
    char name;
    double speed, error;
    bool failed, isOnFront;  ///< the last: worked out by hand
    WorkPoint work() const { return {speed, error, failed}; }
};

inline const std::vector<ExamplePoint>& examplePoints() {
    static const std::vector<ExamplePoint> points{
        {'a', 1, 0.001, false, true}, {'b', 2, 0.02, false, false}, {'c', 4, 0.005, false, true},
        {'d', 4, 0.1, false, false},  {'e', 16, 0.05, false, true}, {'f', 16, 0.05, false, true},
        {'g', 8, 0.3, false, false},  {'h', 32, 0.002, true, false}};
    return points;
}

}  // namespace ballpit
