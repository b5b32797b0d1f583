// Chapter 10: one step as a sequence of stages, and which copy of the bodies each reads and writes.
#pragma once

#include <algorithm>

#include "10_full_system/step_stages.cuh"

namespace ballpit {

using Copies = RigidBodySystem::Copies;

/// The copy that comes `distance` after this one, in a ring.
inline std::size_t following(std::size_t copy, std::size_t distance) {
    return (copy + distance) % RigidBodySystem::copyCount;
}

/// Of the three copies, the one that is neither committed nor in use.
inline std::size_t otherWorkingCopy(std::size_t committed, std::size_t inUse) {
    return inUse == committed ? following(committed, 1) : 3 - committed - inUse;
}

/// Builds the grid; the bodies go to the working copies that are free, which are returned.
inline Copies sortInto(StepStages& stages, Copies committed, Copies now) {
    const Copies sorted{otherWorkingCopy(committed.moving, now.moving),
                        otherWorkingCopy(committed.fixed, now.fixed)};
    stages.buildGrid(now, sorted);
    return sorted;
}

/// How much of (half a cell - radius) a body may move in a round, so that all rounds together stay
/// within what the grid can follow. After the last round, and with a grid that is built in every
/// round, nothing depends on it.
inline float motionShare(int round, int rounds, bool rebuild) {
    constexpr float unlimited = 1e30f;
    if (rebuild || round == rounds - 1) return unlimited;
    return 1.0f / static_cast<float>(std::max(1, rounds - 1));
}

/// Enqueues all stages of a step that starts from the copies `from`, which stay as they are.
/// Returns the copies that will hold the result. `rebuild`: the grid is built in every round.
inline Copies enqueueStep(StepStages& stages, Copies from, bool rebuild) {
    const int rounds = *stages.settings().iterations;
    stages.beginReport();
    Copies now{following(from.moving, 1), from.fixed};
    stages.integrate(from, now);
    now = sortInto(stages, from, now);
    for (int round = 0; round < rounds; ++round) {
        if (rebuild && round > 0) {
            stages.hash(now);
            now = sortInto(stages, from, now);
        }
        stages.detectCollisions(now);
        const Copies resolved{otherWorkingCopy(from.moving, now.moving), now.fixed};
        stages.resolveCollisions(now, resolved, motionShare(round, rounds, rebuild));
        now = resolved;
    }
    stages.sendReport();
    return now;
}

}  // namespace ballpit
