// Chapter 10: the stages of a step, each a piece of an earlier chapter, and the memory they share.
#pragma once

#include <memory>
#include <vector>

#include "03_sort/sort.cuh"
#include "06_broad_phase/broad_phase.cuh"
#include "10_full_system/responses.cuh"
#include "10_full_system/simulator_settings.h"
#include "10_full_system/step_parts.cuh"
#include "common/hole.cuh"
#include "common/pass_on.cuh"
#include "common/readback.cuh"
#include "common/rigid_body.cuh"
#include "common/stage_timer.h"

namespace ballpit {

/// Owns the bodies, the grid, the pair list and the response. A stage reads one copy of the bodies
/// and writes another; none waits for the device.
class EngineStages {
public:
    using Copies = RigidBodySystem::Copies;

    /// InputError if the settings make no sense or need more memory than the device has.
    explicit EngineStages(const SimulatorSettings& settings)
        : settings_(checked(settings)),
          count_(settings.objects),
          bodies_(settings.device, static_cast<std::size_t>(count_)),
          grid_(settings.device, gridBounds(settings_), settings_.cellSize, count_),
          pairs_(settings.device, static_cast<std::size_t>(count_), settings.firstPairCapacity()),
          response_(makeResponse(settings_)),
          status_(settings.device),
          scratch_(settings.device, 0, "scratch"),
          timer_(settings.device) {
        timer_.enable(settings.timeStages);
        prepareGrid();
    }

    RigidBodySystem& bodies() { return bodies_; }
    const SimulatorSettings& settings() const { return settings_; }
    const UniformGrid& grid() const { return grid_; }

    /// True if bodies are sorted into cells; false if one cell holds them all, in any order.
    bool sortsBodies() const { return settings_.broadPhase == BroadPhaseMethod::grid; }

    /// Device bytes in use, and what will be in use before anything has grown.
    std::size_t bytes() const {
        return bodies_.bytes() + grid_.bytes() + pairs_.bytes() + response_->bytes();
    }
    static std::size_t predictedBytes(const SimulatorSettings& s) {
        const auto count = static_cast<std::size_t>(s.objects);
        return RigidBodySystem::predictedBytes(count) +
               UniformGrid::predictedBytes(gridBounds(s), withCells(s).cellSize, count) +
               PairList::predictedBytes(count, s.firstPairCapacity()) + predictedResponseBytes(s);
    }

    // The stages, in the order they run.

    /// Empties the step's report.
    void beginReport() { launch<clearStatus>(settings_.device, 1, status_.view()); }

    /// Moves the bodies, `from` to `to`, and hashes them.
    void integrate(Copies from, Copies to) {
        timer_.start("integrate + hash");
        // ---- hole system.integrate (about 4 lines): One launch of integrateAndHash, from one copy into the other
        TODO_HOLE("system.integrate");
        passOn(settings_.device, count_, bodies_.view(from), bodies_.view(to));  // nobody moves
        hash(to);
        // ---- end of system.integrate
    }

    /// Hashes bodies that already moved: for a grid that is built again within a step.
    void hash(Copies from) {
        timer_.start("integrate + hash");
        launch<computeGridHash>(settings_.device, count_, grid_.view(),
                                bodies_.view(from).positions, grid_.hashes.view(),
                                grid_.indices.view(), status_.view());
    }

    /// Sorts by hash, moves the bodies into cell order, `from` to `to`, and finds the cells.
    void buildGrid(Copies from, Copies to) {
        // ---- hole system.build_grid (about 5 lines): Sort, clear the cells, reorder and find the cells, in the right order
        TODO_HOLE("system.build_grid");
        passOn(settings_.device, count_, bodies_.view(from), bodies_.view(to));  // unsorted
        // ---- end of system.build_grid
    }

    /// Lists all touching pairs of the bodies in `copies`.
    void detectCollisions(Copies copies) {
        timer_.start("broad phase");
        // ---- hole system.detect (about 2 lines): Let findPairsGrid fill the pair list
        TODO_HOLE("system.detect");
        // ---- end of system.detect
    }

    /// Resolves the listed pairs, `from` to `to`.
    void resolveCollisions(Copies from, Copies to, float motionShare) {
        timer_.start("response");
        // ---- hole system.resolve (about 2 lines): Give the response its round: from one copy into the other
        TODO_HOLE("system.resolve");
        passOn(settings_.device, count_, bodies_.view(from), bodies_.view(to));  // no contacts
        // ---- end of system.resolve
    }

    /// Sends the step's report to the host after all stages so far.
    void sendReport() {
        timer_.stop();
        status_.enqueueCopy();
    }

protected:
    /// Takes other settings for the same bodies in the same world: a new grid and a new response.
    void adopt(const SimulatorSettings& settings) {
        requireSensible(settings);
        settings_ = completedSettings(settings);
        grid_ = UniformGrid(settings_.device, settings_.bounds, settings_.cellSize, count_);
        prepareGrid();
        response_ = makeResponse(settings_);
        response_->reserve(pairs_.pairs.count());
    }

    SimulatorSettings settings_;
    int count_;
    RigidBodySystem bodies_;
    UniformGrid grid_;
    PairList pairs_;
    std::unique_ptr<Response> response_;
    Readback<StepStatus> status_;
    Scratch scratch_;
    StageTimer timer_;

private:
    /// The settings, once they are known to make sense and to fit the device's memory; the knobs
    /// left empty have the response's own values.
    static SimulatorSettings checked(const SimulatorSettings& s) {
        requireSensible(s);
        requireMemory(predictedBytes(s), s);
        return completedSettings(s);
    }
    static SimulatorSettings completedSettings(SimulatorSettings s) {
        static_cast<ResponseKnobs&>(s) = completed(s.response, s, length(s.gravity), s.dt);
        return withCells(s);
    }
    static SimulatorSettings withCells(SimulatorSettings s) {
        if (s.broadPhase == BroadPhaseMethod::naive) s.cellSize = oneCellForAll;
        return s;
    }

    /// Before it is built for the first time, a grid holds nobody; one cell for all holds
    /// everybody, for ever.
    void prepareGrid() {
        grid_.cellStarts.fill(0);
        grid_.cellEnds.fill(0);
        grid_.sortedHashes.fill(0);
        if (!sortsBodies()) grid_.cellEnds.upload(std::vector{static_cast<std::uint32_t>(count_)});
    }
};

}  // namespace ballpit
