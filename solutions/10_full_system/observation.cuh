// What can be seen of a simulation between two steps. Each thing is fetched from the device when it
// is first asked for, so nobody pays for what nobody looks at.
#pragma once

#include <optional>

#include "10_full_system/ledger.h"
#include "10_full_system/physics_simulator.cuh"
#include "common/coloring.h"

namespace ballpit {

class Observation {
public:
    /// Of the state before the first step.
    Observation(PhysicsSimulator& simulator, const Scene& scene)
        : simulator_(simulator), scene_(scene), balls_(scene.spheres), topSpeed_(topSpeed(scene)) {}

    /// A step was done: all that was fetched is out of date.
    void stepDone(StepStats stats) {
        stats_ = std::move(stats);
        ++step_;
        // A running mean: numbers that jump cannot be read.
        const auto share = 1.0 / static_cast<double>(std::min(step_, 20L));
        stepMilliseconds_ += share * (stats_.frameTimeMs - stepMilliseconds_);
        hasPositions_ = hasVelocities_ = false;
        figures_.reset();
    }

    long step() const { return step_; }
    std::size_t count() const { return balls_.count(); }
    RigidBodySystem& bodies() { return simulator_.bodies(); }
    const std::vector<float>& radii() const { return balls_.radii; }

    const std::vector<Vec3>& positions() {
        if (!std::exchange(hasPositions_, true))
            balls_.positions = simulator_.bodies().positions.download();
        return balls_.positions;
    }

    /// All of the state.
    const Spheres& balls() {
        positions();
        if (!std::exchange(hasVelocities_, true))
            balls_.velocities = simulator_.bodies().velocities.download();
        return balls_;
    }

    std::vector<Vec3> colors(ColorBy by) {
        if (by == ColorBy::body) return balls_.colors;
        const bool needsPairs = by == ColorBy::contacts && step_ > 0;
        const std::vector<Pair> pairs = needsPairs ? touchingPairs() : std::vector<Pair>{};
        const std::vector<std::uint32_t> order = simulator_.bodies().idsInMemoryOrder();
        return colorsBy(by,
                        {balls(), pairs, order, scene_.bounds.lower, scene_.cellSize, topSpeed_});
    }

    /// Energy, momentum, penetrations, hash: measured on the host.
    const MeasuredFigures& figures() {
        if (!figures_)
            figures_ = {step_,
                        measure(balls(), scene_.bounds, scene_.gravity, scene_.dt, scene_.periodic),
                        stateHash(balls())};
        return *figures_;
    }

    /// Brings a ledger up to date, all but its figures.
    void writeInto(Ledger& ledger) const {
        ledger.scene = scene_.name;
        ledger.balls = count();
        ledger.step = step_;
        ledger.seconds = static_cast<double>(step_) * scene_.dt;
        ledger.contacts = stats_.collisions;
        ledger.stepMilliseconds = stepMilliseconds_;
        if (!stats_.stages.empty()) ledger.stages = stats_.stages;
    }

private:
    /// The listed pairs that touch. With substeps near ones are listed as well; those that were
    /// pushed apart touch to a hair.
    std::vector<Pair> touchingPairs() {
        constexpr float hair = 1e-3f;  // of a distance
        std::vector<Pair> pairs = simulator_.lastPairs();
        if (!simulator_.movesInSubsteps()) return pairs;
        const Spheres& now = balls();
        std::erase_if(pairs, [&](Pair pair) {
            const float reach = now.radii[pair.first] + now.radii[pair.second];
            const Vec3 line = now.positions[pair.second] - now.positions[pair.first];
            return length(line) > (1.0f + hair) * reach;
        });
        return pairs;
    }

    /// What falls from top to floor arrives with this, and nothing that starts faster is slower.
    static float topSpeed(const Scene& scene) {
        float speed = std::sqrt(2.0f * length(scene.gravity) * extent(scene.bounds).y);
        for (const Vec3 velocity : scene.spheres.velocities)
            speed = std::max(speed, length(velocity));
        return std::max(speed, 1e-3f);
    }

    PhysicsSimulator& simulator_;
    const Scene& scene_;
    StepStats stats_;
    long step_ = 0;
    double stepMilliseconds_ = 0.0;
    Spheres balls_;
    bool hasPositions_ = true, hasVelocities_ = true;
    std::optional<MeasuredFigures> figures_;
    float topSpeed_;
};

}  // namespace ballpit
