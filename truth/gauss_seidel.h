// Owns the sequential reference of the time-stepping scheme, in double precision: semi-implicit
// Euler, contacts looked for at the end of the motion, one impulse and one push a pair, pairs one
// after the other, each seeing what the ones before it did (Gauss-Seidel).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/random.h"
#include "truth/contacts.h"

namespace ballpit::truth {

/// In which order the contacts of a pass take their turn, by the numbers of their balls. For a
/// column numbered from the floor: from below, from above, or drawn anew for each pass.
enum class ContactOrder { rising, falling, random };

/// Where walls act: once a step, right after the motion, by putting balls back; or in each pass, as
/// contacts like all others.
enum class WallTurn { oncePerStep, everyPass };

struct StepSettings {
    Box walls{{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};  ///< m
    Vector gravity;                                  ///< m/s^2
    double damping = 0;                              ///< 1/s: share of the velocity lost a second
    double dt = 1.0 / 60;                            ///< s
    int passes = 2;                                  ///< detect and resolve, a step
    double projection = 1;            ///< share of an overlap that a pass pushes apart (beta)
    double restitutionThreshold = 0;  ///< m/s: slower approaches do not bounce
    ContactOrder order = ContactOrder::rising;
    WallTurn wallTurn = WallTurn::oncePerStep;
    std::uint64_t seed = 1;  ///< of the random order
};

/// Since the start.
struct StepCounts {
    std::uint64_t impulses = 0;  ///< pairs of balls that got one
    std::uint64_t visits = 0;    ///< contacts looked at, in all passes
};

class GaussSeidel {
public:
    GaussSeidel(Balls balls, const StepSettings& settings);

    void step();
    void run(int steps) {
        for (int k = 0; k < steps; ++k) step();
    }

    Balls& balls() { return balls_; }
    const StepCounts& counts() const { return counts_; }

private:
    void bounceOffWalls(Ball& ball);
    void resolve(const Contact& contact);

    Balls balls_;
    StepSettings settings_;
    std::vector<Wall> walls_;
    std::uint64_t passesDone_ = 0;
    StepCounts counts_;
};

/// The first half of a semi-implicit Euler step: v += g dt, v *= 1 - damping dt. Then x += v dt.
void kick(Ball& ball, const StepSettings& settings);

/// Puts a list of contacts, sorted upwards, into another order.
template <class Item>
void inOrder(std::vector<Item>& items, ContactOrder order, std::uint64_t seed) {
    if (order == ContactOrder::falling) std::reverse(items.begin(), items.end());
    if (order != ContactOrder::random) return;
    Random random(seed);  // Fisher and Yates; the bias of the remainder is below 1e-15
    for (std::size_t k = items.size(); k > 1; --k)
        std::swap(items[k - 1], items[random.next() % k]);
}

}  // namespace ballpit::truth
