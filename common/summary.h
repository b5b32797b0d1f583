// What an executable says at the end of a run.
#pragma once

#include <string>

#include "common/device.h"
#include "common/metrics.h"
#include "common/scene.h"

namespace ballpit {

struct Summary {
    std::string scene;
    Device device = Device::cpu;
    std::size_t balls = 0;
    int steps = 0, stepsAsked = 0;
    bool interrupted = false;        ///< by Ctrl-C
    float dt = 0.0f;                 ///< s
    double millisecondsPerStep = 0;  ///< wall time, mean over the run
    std::string plan;                ///< the response and its settings, in short
    int readings = 0;                ///< of the scene's facts, by a plan; 0: none was made
    double planShare = 0;            ///< of the wall time, spent on that
    std::size_t collisions = 0;      ///< touching pairs found, over all steps
    std::size_t overflows = 0;       ///< steps redone because the pair list was full
    std::size_t rebuilds = 0;        ///< steps in which the grid was built twice
    std::size_t outside = 0;         ///< times a ball was outside the world when hashed
    Metrics metrics;                 ///< of the final state
    std::uint64_t hash = 0;          ///< of the final state
    std::string video, picture, save;
};

/// As text for people, or as one line of JSON.
void printSummary(const Summary& summary, bool json);

}  // namespace ballpit
