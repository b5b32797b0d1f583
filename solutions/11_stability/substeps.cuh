// Chapter 11: a step of several substeps on one list of pairs: its stages, and their sequence.
#pragma once

#include "10_full_system/one_step.cuh"
#include "11_stability/periodic.cuh"
#include "11_stability/reach.cuh"

namespace ballpit {

/// How far balls may be pushed beyond their expected way, in radii. It doubles when a ball left its
/// reach in a step, and halves again after a while without need: longer reaches list more pairs,
/// but a list for each substep costs more.
class ReachSlack {
public:
    float inRadii() const { return 0.05f * static_cast<float>(1 << doublings_); }
    int doublings() const { return doublings_; }

    /// For step `step` and some more. False if the slack is the largest already.
    bool widen(long step) {
        if (doublings_ == mostDoublings) return false;
        ++doublings_;
        keptUntil_ = step + stepsKept;
        return true;
    }

    /// Before step `step`. Asked twice before the same step, it changes nothing the second time.
    void narrow(long step) {
        if (doublings_ == 0 || step < keptUntil_) return;
        --doublings_;
        keptUntil_ = step + stepsKept;
    }

private:
    static constexpr int mostDoublings = 2;
    static constexpr long stepsKept = 16;

    int doublings_ = 0;
    long keptUntil_ = 0;
};

class SubstepStages : public PeriodicStages {
public:
    explicit SubstepStages(const SimulatorSettings& settings)
        : PeriodicStages(settings),
          grown_(settings.device, movesInSubsteps() ? static_cast<std::size_t>(count_) : 0,
                 "ballsWithReach") {}

    /// True if the response wants a step of substeps, not of rounds.
    bool movesInSubsteps() const { return response_->stepKind() == StepKind::substeps; }

    std::size_t bytes() const { return EngineStages::bytes() + grown_.bytes(); }

    const ReachSlack& slack() const { return slack_; }

    /// Moves the bodies freely for a substep, to others or where they are; walls are the
    /// response's. Hashes them as well, in case the grid is built next.
    void moveFreely(Copies from, Copies to) {
        timer_.start("integrate + hash");
        launch<integrateAndHash>(
            settings_.device, count_, bodies_.view(from), bodies_.view(to),
            MotionSettings{settings_.gravity, settings_.damping, substep(), noWalls()},
            grid_.view(), grid_.hashes.view(), grid_.indices.view(), status_.view());
    }

    /// Lists all pairs that can meet while the bodies move `moves` times more.
    void detectWithinReach(Copies copies, int moves) {
        timer_.start("broad phase");
        const BodiesView bodies = bodies_.view(copies);
        // A list that serves one substep alone needs no more than the least slack.
        const float slack = (moves == 0 ? ReachSlack() : slack_).inRadii();
        const ReachSettings reach{static_cast<float>(moves) * substep(), length(settings_.gravity),
                                  slack, 0.5f * grid_.cellSize};
        launch<growByReach>(settings_.device, count_, bodies, reach, grown_.view());
        findPairsGrid(settings_.device, count_, grid_.view(), grid_.sortedHashes.view(),
                      grown_.view(), pairs_, status_.view(), scratch_);
        launch<clearTouching>(settings_.device, 1, status_.view());
        launch<countTouching>(settings_.device, count_, bodies.positions, pairs_.view(),
                              status_.view());
    }

    /// Reports a body that has left its reach.
    void checkReach(Copies copies) {
        launch<reportReach>(settings_.device, count_, bodies_.view(copies), grown_.view(),
                            status_.view());
    }

    /// Resolves the listed pairs, `from` to `to`. `newPairs`: the list is used for the first time.
    void resolveSubstep(Copies from, Copies to, bool newPairs) {
        timer_.start("response");
        constexpr float unlimited = 1e30f;
        response_->resolve({count_, bodies_.view(from), bodies_.view(to), pairs_.view(),
                            0.5f * grid_.cellSize, unlimited, status_.view(), newPairs});
    }

protected:
    void adopt(const SimulatorSettings& settings) {
        EngineStages::adopt(settings);
        if (movesInSubsteps() && grown_.count() == 0)
            grown_.resize(static_cast<std::size_t>(count_));
    }

    /// Makes the cells larger than the balls, so that these can reach beyond themselves. True if
    /// the grid is a new one.
    bool makeRoomToReach() {
        const float wanted = roomToReach * 2.0f * bodies_.largestRadius();
        if (!movesInSubsteps() || grid_.cellSize >= wanted) return false;
        grid_ = UniformGrid(settings_.device, settings_.bounds, wanted, count_);
        return true;
    }

    ReachSlack slack_;

private:
    /// Cells, in diameters of the largest ball.
    static constexpr float roomToReach = 1.4f;

    /// s.
    float substep() const { return settings_.dt / static_cast<float>(*settings_.substeps); }

    DeviceBuffer<Vec4> grown_;  ///< balls grown by their reach
};

/// Enqueues a step of substeps: on one list of pairs for all of them, or, to be on the safe side
/// (`rebuild`), on a list for each. With a list for each, a body may move as far as it likes, as
/// with one round a step. Returns the copies that will hold the result.
inline Copies enqueueSubsteps(SubstepStages& stages, Copies from, bool rebuild) {
    const int substeps = *stages.settings().substeps;
    stages.beginReport();
    Copies now = from;
    for (int substep = 0; substep < substeps; ++substep) {
        const Copies moved{substep == 0 ? otherWorkingCopy(from.moving, from.moving) : now.moving,
                           now.fixed};
        stages.moveFreely(now, moved);
        now = moved;
        const bool newPairs = substep == 0 || rebuild;
        if (newPairs) {
            now = sortInto(stages, from, now);
            stages.detectWithinReach(now, rebuild ? 0 : substeps - 1);
        } else {
            stages.checkReach(now);
        }
        const Copies resolved{otherWorkingCopy(from.moving, now.moving), now.fixed};
        stages.resolveSubstep(now, resolved, newPairs);
        now = resolved;
        if (!rebuild) stages.checkReach(now);
    }
    stages.sendReport();
    return now;
}

}  // namespace ballpit
