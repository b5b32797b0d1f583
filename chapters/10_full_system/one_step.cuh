// Chapter 10: one step as a sequence of stages, and which copy of the bodies each reads and writes.
#pragma once

#include <algorithm>

#include "10_full_system/engine_stages.cuh"
#include "common/hole.cuh"

namespace ballpit {

using Copies = RigidBodySystem::Copies;

/// Of the copies 0, 1 and 2, one that is neither committed nor in use. (At the start of a step the
/// committed copy is the one in use: then either of the others will do.)
inline std::size_t otherWorkingCopy(std::size_t committed, std::size_t inUse) {
    // ---- hole system.copies (about 2 lines): A copy that is neither committed nor in use
    TODO_HOLE("system.copies");
    return (inUse + 1) % RigidBodySystem::copyCount;  // the next one, whatever lies there
    // ---- end of system.copies
}

/// Builds the grid; the bodies go to the working copies that are free, which are returned. With one
/// cell for all there is nothing to build, and the bodies stay where they are.
inline Copies sortInto(EngineStages& stages, Copies committed, Copies now) {
    if (!stages.sortsBodies()) return now;
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
/// Stages: EngineStages, or a class that has the same and some of its own (chapter 11's box).
template <class Stages>
Copies enqueueStep(Stages& stages, Copies from, bool rebuild) {
    const int rounds = *stages.settings().iterations;
    stages.beginReport();
    Copies now = from;
    // ---- hole system.begin (about 3 lines): Integrate into a free copy, then build the grid
    TODO_HOLE("system.begin");
    // ---- end of system.begin
    // ---- hole system.rounds (about 10 lines): Each round: the grid anew if asked; detect; resolve into the free copy
    TODO_HOLE("system.rounds");
    // ---- end of system.rounds
    stages.sendReport();
    return now;
}

}  // namespace ballpit
