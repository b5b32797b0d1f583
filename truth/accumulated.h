// Owns the other sequential scheme: all contacts of a step solved together by repeated passes over
// impulses that add up (projected Gauss-Seidel), started from those of the step before. It
// converges to the answer in which no contact approaches and none pulls.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "truth/gauss_seidel.h"

namespace ballpit::truth {

class Accumulated {
public:
    /// Of `settings`, wallTurn is not used: walls are contacts. `slop`, m: an overlap left alone,
    /// so that a resting contact is found in every step.
    Accumulated(Balls balls, const StepSettings& settings, double slop, bool warmStart = true);

    /// Velocities by gravity; contacts found; `passes` over their impulses; then positions by the
    /// new velocities, and two passes that push overlaps apart.
    void step();
    void run(int steps) {
        for (int k = 0; k < steps; ++k) step();
    }

    Balls& balls() { return balls_; }

    /// The impulse that this contact got in the last step, N s; 0 if there was none. Walls are ~0
    /// to ~5: lower and upper in x, y, z.
    double impulseOf(int a, int b) const;

private:
    using Key = std::pair<int, int>;
    struct Solved {
        Contact contact;
        Vector normal;
        double target;   ///< m/s: how fast the two should leave each other
        double impulse;  ///< N s, never negative
    };

    std::vector<Solved> findContacts() const;
    void improve(Solved& solved);
    void pushApart(const std::vector<Solved>& contacts);

    Balls balls_;
    StepSettings settings_;
    double slop_;
    bool warmStart_;
    std::vector<Wall> walls_;
    std::map<Key, double> impulses_;
    std::uint64_t stepsDone_ = 0;
};

}  // namespace ballpit::truth
