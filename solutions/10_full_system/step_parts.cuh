// Chapter 10: what a step reports, and the small kernels that only the whole system needs.
#pragma once

#include <string>
#include <vector>

#include "02_grid_hash/grid_hash.cuh"
#include "04_reorder/reorder.cuh"
#include "05_cell_bounds/cell_bounds.cuh"
#include "07_impulse_response/integrate.cuh"
#include "common/error.h"
#include "common/stage_timer.h"

namespace ballpit {

struct StepStats {
    std::uint32_t collisions = 0;   ///< touching pairs in the first round
    std::uint32_t listed = 0;       ///< the most pairs that a round listed: those within reach
    double frameTimeMs = 0.0;       ///< wall time of the step
    std::uint32_t outside = 0;      ///< bodies that were outside the world when hashed
    std::uint32_t overflow = 0;     ///< pairs found beyond the capacity, before it grew; none lost
    bool gridRebuilt = false;       ///< the grid was built again between the rounds
    std::vector<StageTime> stages;  ///< with SimulatorSettings::timeStages
};

// Two kernels that run two stages on the same index: a launch each for what would be four.

HD inline void integrateAndHash(int i, BodiesView from, BodiesView to, MotionSettings motion,
                                GridView grid, View<std::uint32_t> hashes,
                                View<std::uint32_t> indices, View<StepStatus> status) {
    integrate(i, from, to, motion, status);
    computeGridHash(i, grid, to.positions, hashes, indices, status);
}

HD inline void reorderAndFindCells(int i, int count, View<const std::uint32_t> sortedHashes,
                                   View<const std::uint32_t> sortedIndices, BodiesView from,
                                   BodiesView to, GridView grid) {
    reorderData(i, sortedIndices, from, to);
    findCellStart(i, count, sortedHashes, grid);
}

/// Nothing to report yet. One thread.
HD inline void clearStatus(int, View<StepStatus> status) {
    status[0] = {0, 0, 0, 0, 0, 0, noBody, noBody};
}

inline void requireCountable(const StepStatus& status) {
    if (status.pairsUncountable)
        throw std::runtime_error(
            "more touching pairs than 32 bits can count: nearly all balls lie in one place");
}

/// NotFiniteError naming the body, the stage and the step.
inline void requireFinite(const StepStatus& status, long step) {
    const bool early = status.notFiniteAfterMoving != noBody;
    const std::uint32_t body = early ? status.notFiniteAfterMoving : status.notFiniteAfterImpulse;
    if (body == noBody) return;
    throw NotFiniteError("body " + std::to_string(body) + " is not finite after " +
                         (early ? "integrate" : "collisionResponse") + " of step " +
                         std::to_string(step) + "; the state before this step is kept");
}

}  // namespace ballpit
