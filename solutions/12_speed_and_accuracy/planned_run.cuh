// Chapter 12: a run that follows a plan, and changes it when the scene has become another one.
#pragma once

#include <chrono>
#include <optional>

#include "12_speed_and_accuracy/plan.h"
#include "12_speed_and_accuracy/scene_facts.cuh"

namespace ballpit {

/// Frames between two readings of the facts: a reading costs about as much as half a step, and is
/// to take less than 1 % of a run.
constexpr long framesBetweenReadings = 120;

/// Plans for a simulator, at its start and whenever facts are read again.
class Planner {
public:
    /// Reads the facts of what is in the simulator and has it follow the plan.
    Planner(PhysicsSimulator& simulator, const Scene& scene, double tolerance,
            const PlanThresholds& thresholds = {})
        : simulator_(simulator),
          settings_(simulator.settings()),
          world_(worldOf(scene)),
          tolerance_(tolerance),
          thresholds_(thresholds),
          reader_(settings_.device, settings_.objects) {
        const Timing timing(*this);
        adopt(makePlan(reader_.read(simulator_), world_, tolerance_, thresholds_));
    }

    const Plan& plan() const { return plan_; }
    double milliseconds() const { return milliseconds_; }  ///< of wall time, spent on planning
    int readings() const { return readings_; }

    /// Makes a frame: calls step() as often as the plan says. Before, when it is time, reads the
    /// facts again; if they ask for other settings, changes to these and says what they are.
    template <class Step>
    std::optional<std::string> frame(Step step) {
        std::optional<std::string> change;
        if (frames_ > 0 && frames_ % framesBetweenReadings == 0) change = readAgain();
        ++frames_;
        for (int k = 0; k < plan_.stepsAFrame; ++k) step();
        return change;
    }

private:
    std::optional<std::string> readAgain() {
        const Timing timing(*this);
        const Plan next =
            makePlan(reader_.read(simulator_), world_, tolerance_, thresholds_, &plan_);
        if (sameSettings(next, plan_)) return std::nullopt;
        const std::string line = "frame " + std::to_string(frames_) + ": " + inShort(plan_) +
                                 " -> " + inShort(next) + " (" + reasonOf(next) + ")";
        adopt(next);
        return line;
    }

    /// Adds the time of its own life to the planner's.
    class Timing {
    public:
        explicit Timing(Planner& planner) : planner_(planner) { ++planner.readings_; }
        ~Timing() {
            planner_.milliseconds_ +=
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
                    .count();
        }
        Timing(const Timing&) = delete;

    private:
        Planner& planner_;
        std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    };

    void adopt(const Plan& plan) {
        plan_ = plan;
        simulator_.change(planned(settings_, plan, world_));
    }

    /// Why a plan differs from the one before it: the first choice that does.
    std::string reasonOf(const Plan& next) const {
        for (const Choice& choice : next.choices)
            for (const Choice& old : plan_.choices)
                if (choice.what == old.what && choice.value != old.value) return choice.because;
        return next.choices.front().because;
    }

    PhysicsSimulator& simulator_;
    SimulatorSettings settings_;  ///< those of the scene
    World world_;
    double tolerance_;
    PlanThresholds thresholds_;
    FactReader reader_;
    Plan plan_;
    long frames_ = 0;
    double milliseconds_ = 0;
    int readings_ = 0;
};

}  // namespace ballpit
