// Chapter 10: all pieces together. One step: integrate; hash, sort, reorder, cell bounds; then
// `iterations` rounds of detect and resolve.
//
// A step is a transaction. It reads the committed copy of the bodies and writes the other two; at
// the end the host looks at what the device reports, once, and either commits the new copy or,
// when the pair list was too short or the grid went stale, repeats the step from the same start
// with the cause removed. So nothing is dropped, and a failed step loses nothing.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <tuple>

#include "03_sort/sort.cuh"
#include "06_broad_phase/broad_phase.cuh"
#include "07_impulse_response/atomic_response.cuh"
#include "07_impulse_response/impulse_response.cuh"
#include "07_impulse_response/racy_response.cuh"
#include "10_full_system/simulator_settings.h"
#include "10_full_system/step_parts.cuh"
#include "common/launch_recording.cuh"
#include "common/readback.cuh"
#include "common/rigid_body.cuh"
#include "common/stage_timer.h"

namespace ballpit {

class PhysicsSimulator {
public:
    /// InputError if the settings make no sense or need more memory than the device has.
    explicit PhysicsSimulator(const SimulatorSettings& settings)
        : settings_(checked(settings)),
          count_(settings.objects),
          bodies_(settings.device, static_cast<std::size_t>(count_)),
          grid_(settings.device, settings.bounds, settings.cellSize, count_),
          pairs_(settings.device, static_cast<std::size_t>(count_), settings.firstPairCapacity()),
          response_(makeResponse(settings)),
          status_(settings.device),
          scratch_(settings.device, 0, "scratch"),
          timer_(settings.device) {
        timer_.enable(settings.timeStages);
    }

    RigidBodySystem& bodies() { return bodies_; }
    const SimulatorSettings& settings() const { return settings_; }
    const UniformGrid& grid() const { return grid_; }

    /// Advances all bodies by dt. InputError if a ball is larger than a cell or than the world;
    /// NotFiniteError naming the body, step and stage, with the state before this step kept.
    StepStats step() {
        const StepStats stats = attemptUntilComplete();
        bodies_.commit(next_);
        ++stepsDone_;
        return stats;
    }

    /// Does all of a step's work, but keeps the state from before it. For measuring.
    StepStats rehearseStep() { return attemptUntilComplete(); }

    /// Whether steps fill StepStats::stages from now on.
    void timeStages(bool on) {
        settings_.timeStages = on;
        timer_.enable(on);
    }

    /// The touching pairs of the last round of the last step or rehearsal, by body number:
    /// first < second, sorted.
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

    /// Device bytes in use, and what a simulator will use before it has grown.
    std::size_t bytes() const {
        return bodies_.bytes() + grid_.bytes() + pairs_.bytes() + response_->bytes();
    }
    static std::size_t predictedBytes(const SimulatorSettings& s) {
        const auto count = static_cast<std::size_t>(s.objects);
        const std::size_t response =
            s.response == ResponseMethod::massSplit
                ? ImpulseResponse::predictedBytes(count, s.firstPairCapacity())
                : 0;
        return RigidBodySystem::predictedBytes(count) +
               UniformGrid::predictedBytes(s.bounds, s.cellSize, count) +
               PairList::predictedBytes(count, s.firstPairCapacity()) + response;
    }

    // The stages of a step, in the order they run. Each reads copies of the bodies and writes
    // others; none waits for the device.

    /// Moves the bodies, `from` to `to`, and hashes them.
    void integrate(RigidBodySystem::Copies from, RigidBodySystem::Copies to) {
        timer_.start("integrate + hash");
        launch<integrateAndHash>(
            settings_.device, count_, bodies_.view(from), bodies_.view(to),
            MotionSettings{settings_.gravity, settings_.damping, settings_.dt, settings_.bounds},
            grid_.view(), grid_.hashes.view(), grid_.indices.view(), status_.view());
    }

    /// Hashes bodies that already moved: for a grid that is built again within a step.
    void hash(RigidBodySystem::Copies from) {
        timer_.start("integrate + hash");
        launch<computeGridHash>(settings_.device, count_, grid_.view(),
                                bodies_.view(from).positions, grid_.hashes.view(),
                                grid_.indices.view(), status_.view());
    }

    /// Sorts by hash, moves the bodies into cell order, `from` to `to`, and finds the cells.
    void buildGrid(RigidBodySystem::Copies from, RigidBodySystem::Copies to) {
        timer_.start("sort");
        sortByHash(settings_.device, count_, grid_, scratch_);
        timer_.start("reorder + cell bounds");
        clearCells(grid_);
        launch<reorderAndFindCells>(settings_.device, count_, count_, grid_.sortedHashes.view(),
                                    grid_.sortedIndices.view(), bodies_.view(from),
                                    bodies_.view(to), grid_.view());
    }

    /// Lists all touching pairs of the bodies in `copies`.
    void detectCollisions(RigidBodySystem::Copies copies) {
        timer_.start("broad phase");
        findPairsGrid(settings_.device, count_, grid_.view(), grid_.sortedHashes.view(),
                      bodies_.view(copies).positions, pairs_, status_.view(), scratch_);
    }

    /// Resolves the listed pairs, `from` to `to`.
    void resolveCollisions(RigidBodySystem::Copies from, RigidBodySystem::Copies to,
                           float motionShare) {
        timer_.start("response");
        response_->resolve({count_, bodies_.view(from), bodies_.view(to), pairs_.view(),
                            0.5f * grid_.cellSize, motionShare, status_.view()});
    }

private:
    using Copies = RigidBodySystem::Copies;

    /// The launches of a step from one constellation of copies, and where its result lies.
    struct RecordedStep {
        LaunchRecording launches;
        Copies result;
    };

    /// The settings, once they are known to make sense and to fit the device's memory.
    static const SimulatorSettings& checked(const SimulatorSettings& s) {
        requireSensible(s);
        requireMemory(predictedBytes(s), s);
        return s;
    }

    static std::unique_ptr<Response> makeResponse(const SimulatorSettings& s) {
        if (s.response == ResponseMethod::racy) return std::make_unique<RacyResponse>(s.device);
        if (s.response == ResponseMethod::atomic) return std::make_unique<AtomicResponse>(s.device);
        return std::make_unique<ImpulseResponse>(s.device, static_cast<std::size_t>(s.objects),
                                                 s.firstPairCapacity());
    }

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

    /// Repeats the step until nothing was cut short. Leaves the result in next_.
    StepStats attemptUntilComplete() {
        const auto start = std::chrono::steady_clock::now();
        requireBallsFit();
        StepStats stats;
        const auto capacityBefore = static_cast<std::uint32_t>(pairs_.pairs.count());
        // With several rounds, balls move while the grid stays. If a ball of the largest radius
        // has no room to move at all, the grid must follow in any case.
        const bool noRoom = 2.0f * bodies_.largestRadius() >= settings_.cellSize;
        bool rebuild = settings_.iterations > 1 && (noRoom || stepsDone_ < rebuildUntil_);
        for (;;) {
            const StepStatus status = attempt(rebuild);
            requireCountable(status);
            if (status.pairsNeeded > pairs_.pairs.count()) {
                stats.overflow = status.pairsNeeded - capacityBefore;
                growPairList(status.pairsNeeded);
                continue;
            }
            requireFinite(status);
            if (status.staleGrid && settings_.iterations > 1 && !rebuild) {
                rebuild = true;
                rebuildUntil_ = stepsDone_ + rebuildSteps;
                continue;
            }
            stats.collisions = status.collisions;
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
        recordings_.clear();
    }

    static void requireCountable(const StepStatus& status) {
        if (status.pairsUncountable)
            throw std::runtime_error(
                "more touching pairs than 32 bits can count: nearly all balls lie in one place");
    }

    void requireFinite(const StepStatus& status) const {
        const bool early = status.notFiniteAfterMoving != noBody;
        const std::uint32_t body =
            early ? status.notFiniteAfterMoving : status.notFiniteAfterImpulse;
        if (body == noBody) return;
        throw NotFiniteError("body " + std::to_string(body) + " is not finite after " +
                             (early ? "integrate" : "collisionResponse") + " of step " +
                             std::to_string(stepsDone_) + "; the state before this step is kept");
    }

    /// One try at a step. Recorded as a CUDA graph the second time the same launches are due (the
    /// first time scratch memory may have to be allocated).
    StepStatus attempt(bool rebuild) {
        const Copies from = bodies_.state();
        timer_.clear();
        const bool useRecording = settings_.device == Device::cuda && !settings_.timeStages;
        if (useRecording && scratchReady_) {
            auto [place, isNew] = recordings_.try_emplace({from.moving, from.fixed, rebuild});
            RecordedStep& step = place->second;
            if (isNew) step.launches.record([&] { step.result = enqueueStep(from, rebuild); });
            step.launches.replay();
            next_ = step.result;
        } else {
            next_ = enqueueStep(from, rebuild);
            scratchReady_ = true;
        }
        return status_.wait();
    }

    static std::size_t following(std::size_t copy, std::size_t distance) {
        return (copy + distance) % RigidBodySystem::copyCount;
    }

    /// Enqueues all stages and returns the copies that will hold the result.
    Copies enqueueStep(Copies from, bool rebuild) {
        launch<clearStatus>(settings_.device, 1, status_.view());
        Copies now{following(from.moving, 1), from.fixed};
        integrate(from, now);
        now = sortInto(from, now);
        const float share = 1.0f / static_cast<float>(std::max(1, settings_.iterations - 1));
        for (int round = 0; round < settings_.iterations; ++round) {
            if (rebuild && round > 0) {
                hash(now);
                now = sortInto(from, now);
            }
            detectCollisions(now);
            const Copies resolved{otherWorkingCopy(from.moving, now.moving), now.fixed};
            const bool last = round == settings_.iterations - 1;
            resolveCollisions(now, resolved, last || rebuild ? unlimitedMotion : share);
            now = resolved;
        }
        timer_.stop();
        status_.enqueueCopy();
        return now;
    }

    /// Builds the grid; the bodies go to the working copies that are free.
    Copies sortInto(Copies committed, Copies now) {
        const Copies sorted{otherWorkingCopy(committed.moving, now.moving),
                            otherWorkingCopy(committed.fixed, now.fixed)};
        buildGrid(now, sorted);
        return sorted;
    }

    /// Of the three copies, the one that is neither committed nor in use.
    static std::size_t otherWorkingCopy(std::size_t committed, std::size_t inUse) {
        return inUse == committed ? following(committed, 1) : 3 - committed - inUse;
    }

    static constexpr float unlimitedMotion = 1e30f;
    /// How many steps the grid is built in every round after it once went stale: trying first
    /// without would nearly always be in vain then.
    static constexpr long rebuildSteps = 16;

    SimulatorSettings settings_;
    int count_;
    RigidBodySystem bodies_;
    UniformGrid grid_;
    PairList pairs_;
    std::unique_ptr<Response> response_;
    Readback<StepStatus> status_;
    Scratch scratch_;
    StageTimer timer_;
    std::map<std::tuple<std::size_t, std::size_t, bool>, RecordedStep> recordings_;
    Copies next_;
    long stepsDone_ = 0;
    long rebuildUntil_ = 0;
    bool scratchReady_ = false;
};

}  // namespace ballpit
