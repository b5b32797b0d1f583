// Chapter 10: all pieces together. One step: integrate; hash, sort, reorder, cell bounds; then
// `iterations` rounds of detect and resolve (or, with some responses of chapter 11, substeps).
//
// A step is a transaction. It reads the committed copy of the bodies and writes the other two; at
// the end the host looks at what the device reports, once, and either commits the new copy or,
// when the pair list was too short or the grid went stale, repeats the step from the same start
// with the cause removed. So nothing is dropped, and a failed step loses nothing.
#pragma once

#include <chrono>
#include <map>
#include <tuple>

#include "10_full_system/engine_stages.cuh"
#include "10_full_system/one_step.cuh"
#include "11_stability/substeps.cuh"
#include "common/hole.cuh"
#include "common/launch_recording.cuh"

namespace ballpit {

/// The whole engine. Its stages, with the bodies and all memory, are in EngineStages; those of
/// substeps in SubstepStages.
class PhysicsSimulator : public SubstepStages {
public:
    using SubstepStages::SubstepStages;

    /// Advances all bodies by dt. InputError if a ball is larger than a cell or than the world;
    /// NotFiniteError naming the body, step and stage, with the state before this step kept.
    StepStats step() {
        const StepStats stats = attemptUntilComplete();
        // ---- hole system.commit (about 1 line): The copies in which the step ended become the state
        TODO_HOLE("system.commit");
        // ---- end of system.commit
        response_->commit();
        ++stepsDone_;
        return stats;
    }

    /// Does all of a step's work, but keeps the state from before it. For measuring.
    StepStats rehearseStep() { return attemptUntilComplete(); }

    /// Goes on with other settings from the next step on. Number of bodies, world and device must
    /// be those there are; the bodies stay as they are. InputError as from the constructor.
    void change(const SimulatorSettings& settings) {
        adopt(settings);
        forgetRecordings();
        rebuildUntil_ = 0;
    }

    /// All touching pairs of the bodies as they are, and the bodies in the same order: what can be
    /// read about a state without changing it. `counts` is memory to work in: before the first use,
    /// counts[i] says how many of the pairs have body i as their first. All of it is good until the
    /// next step.
    struct Survey {
        BodiesView bodies;
        PairsView pairs;
        View<std::uint32_t> counts;
    };
    Survey survey() {
        const Copies from = bodies_.state();
        for (;;) {
            beginReport();
            hash(from);
            const Copies sorted = sortInto(*this, from, from);
            detectCollisions(sorted);
            sendReport();
            const StepStatus status = status_.wait();
            requireCountable(status);
            if (status.pairsNeeded <= pairs_.pairs.count())
                return {bodies_.view(sorted), pairs_.view(), pairs_.counts.view()};
            growPairList(status.pairsNeeded);
        }
    }

    /// Whether steps fill StepStats::stages from now on.
    void timeStages(bool on) {
        settings_.timeStages = on;
        timer_.enable(on);
    }

    /// The listed pairs of the last round of the last step or rehearsal, by body number:
    /// first < second, sorted. They touch; with substeps, they are within reach of each other.
    std::vector<Pair> lastPairs() {
        const std::uint32_t found = pairs_.starts.download().back();
        const std::vector<std::uint32_t> ids = bodies_.idsInMemoryOrder(next_);
        std::vector<Pair> pairs = pairs_.pairs.download(found);
        for (Pair& pair : pairs) {
            const std::uint32_t a = ids[pair.first], b = ids[pair.second];
            pair = {std::min(a, b), std::max(a, b)};
        }
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }

private:
    /// The launches of a step from one constellation of copies, and where its result lies.
    struct RecordedStep {
        LaunchRecording launches;
        Copies result;
    };

    /// The grid finds touching balls only in neighbouring cells, so no ball may be larger than one.
    void requireBallsFit() const {
        const float diameter = 2.0f * bodies_.largestRadius();
        if (diameter > settings_.cellSize)
            throw InputError("cell size " + std::to_string(settings_.cellSize) +
                             " m is smaller than the largest ball's diameter: use at least " +
                             std::to_string(diameter) + " m");
        const Vec3 size = extent(settings_.bounds);
        if (diameter > minimum(size.x, minimum(size.y, size.z)))
            throw InputError("a ball of diameter " + std::to_string(diameter) +
                             " m does not fit between the walls");
    }

    /// A response may be unable to stop a body dead.
    void requireRestitution() const {
        const float least = response_->leastRestitution();
        if (bodies_.smallestRestitution() < least)
            throw InputError("restitution " + std::to_string(bodies_.smallestRestitution()) +
                             ": the response " + name(settings_.response) + " needs at least " +
                             std::to_string(least) + "; any restitution can have " +
                             name(ResponseMethod::coloured) + " or " +
                             name(ResponseMethod::smallSteps));
    }

    /// True if bodies move between the build of the grid and its last use.
    bool gridCanGoStale() const {
        return movesInSubsteps() ? settings_.substeps > 1 : settings_.iterations > 1;
    }

    Copies enqueue(Copies from, bool rebuild) {
        return movesInSubsteps() ? enqueueSubsteps(*this, from, rebuild)
                                 : enqueueStep(*this, from, rebuild);
    }

    /// Repeats the step until nothing was cut short. Leaves the result in next_.
    StepStats attemptUntilComplete() {
        const auto start = std::chrono::steady_clock::now();
        requireBallsFit();
        requireRestitution();
        if (makeRoomToReach()) forgetRecordings();
        slack_.narrow(stepsDone_);
        StepStats stats;
        const auto capacityBefore = static_cast<std::uint32_t>(pairs_.pairs.count());
        // With several rounds, balls move while the grid stays. If a ball of the largest radius
        // has no room to move at all, the grid must follow in any case.
        const bool noRoom = 2.0f * bodies_.largestRadius() >= grid_.cellSize;
        bool rebuild = gridCanGoStale() && (noRoom || stepsDone_ < rebuildUntil_);
        for (;;) {
            const StepStatus status = attempt(rebuild);
            requireCountable(status);
            // ---- hole system.grow (about 5 lines): More pairs than places? Tell how many, make room, try again
            TODO_HOLE("system.grow");
            // ---- end of system.grow
            requireFinite(status, stepsDone_);
            const bool leftReach =
                status.staleGrid && movesInSubsteps() && gridCanGoStale() && !rebuild;
            if (leftReach && slack_.widen(stepsDone_)) continue;
            // ---- hole system.rebuild (about 5 lines): Stale grid? Try again with a grid in every round
            TODO_HOLE("system.rebuild");
            // ---- end of system.rebuild
            stats.collisions = status.collisions;
            stats.listed = status.pairsNeeded;
            stats.outside = status.outside;
            break;
        }
        stats.gridRebuilt = rebuild;
        if (settings_.timeStages) stats.stages = timer_.read();
        stats.frameTimeMs =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count();
        return stats;
    }

    void growPairList(std::size_t needed) {
        if (!settings_.growPairs)
            throw std::runtime_error("pair list full: " + std::to_string(needed) +
                                     " pairs needed, " + std::to_string(pairs_.pairs.count()) +
                                     " available: raise pairCapacity or set growPairs");
        const std::size_t capacity = needed + needed / 4;
        pairs_.pairs.resize(capacity);
        response_->reserve(capacity);
        forgetRecordings();
    }

    /// The arrays have moved. Larger ones may also need more scratch memory.
    void forgetRecordings() {
        recordings_.clear();
        scratchReady_ = false;
    }

    /// One try at a step. Recorded as a CUDA graph the second time the same launches are due (the
    /// first time scratch memory may have to be allocated).
    StepStatus attempt(bool rebuild) {
        const Copies from = bodies_.state();
        timer_.clear();
        const bool useRecording = settings_.device == Device::cuda && !settings_.timeStages;
        if (useRecording && scratchReady_) {
            auto [place, isNew] =
                recordings_.try_emplace({from.moving, from.fixed, rebuild, slack_.doublings()});
            RecordedStep& step = place->second;
            if (isNew) step.launches.record([&] { step.result = enqueue(from, rebuild); });
            step.launches.replay();
            next_ = step.result;
        } else {
            next_ = enqueue(from, rebuild);
            scratchReady_ = true;
        }
        return status_.wait();
    }

    /// How many steps the grid is built in every round after it once went stale: trying first
    /// without would nearly always be in vain then.
    static constexpr long rebuildSteps = 16;

    std::map<std::tuple<std::size_t, std::size_t, bool, int>, RecordedStep> recordings_;
    Copies next_;
    long stepsDone_ = 0;
    long rebuildUntil_ = 0;
    bool scratchReady_ = false;
};

}  // namespace ballpit
