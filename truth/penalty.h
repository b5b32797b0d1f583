// Closed forms of a penalty contact: two balls pushed apart by a spring and a dashpot along their
// normal. Symbols: stiffness k (N/m), effective mass m (kg), omega0 = sqrt(k / m), damping ratio z,
// restitution e, approach speed v (m/s). Valid for 0 < e <= 1, that is 0 <= z < 1.
#pragma once

#include <cmath>
#include <numbers>

namespace ballpit::truth {

/// z that gives the restitution e: -ln e / sqrt(pi^2 + ln^2 e).
inline double dampingRatio(double e) {
    const double logarithm = std::log(e);
    return -logarithm / std::sqrt(std::numbers::pi * std::numbers::pi + logarithm * logarithm);
}

/// And back: e = exp(-pi z / sqrt(1 - z^2)).
inline double restitutionOf(double z) {
    return std::exp(-std::numbers::pi * z / std::sqrt(1 - z * z));
}

/// How long the contact lasts, s: half a period, pi / (omega0 sqrt(1 - z^2)).
inline double contactTime(double k, double m, double z) {
    return std::numbers::pi / (std::sqrt(k / m) * std::sqrt(1 - z * z));
}

/// The deepest overlap, m: v / omega0 exp(-z acos z / sqrt(1 - z^2)), reached after acos(z) /
/// (omega0 sqrt(1 - z^2)).
inline double deepestPenaltyOverlap(double v, double k, double m, double z) {
    return v / std::sqrt(k / m) * std::exp(-z * std::acos(z) / std::sqrt(1 - z * z));
}

/// The stiffness, N/m, with which an elastic contact (an upper bound for all) is `overlap` m deep.
inline double stiffnessFor(double overlap, double v, double m) {
    return m * v * v / (overlap * overlap);
}

/// Semi-implicit steps longer than this blow an undamped spring up, s: 2 / omega0.
inline double longestStableStep(double k, double m) { return 2 / std::sqrt(k / m); }

/// A spring (1/s^2) and a dashpot (1/s) over the effective mass: contacts last `contactTime` s and
/// leave the restitution e.
struct ContactSpring {
    double spring, dashpot;
};
inline ContactSpring contactSpring(double contactTime, double e) {
    const double logarithm = std::log(e), pi = std::numbers::pi;
    return {(pi * pi + logarithm * logarithm) / (contactTime * contactTime),
            -2 * logarithm / contactTime};
}

/// The restitution that is left of e where steps move first and then press (semi-implicit), so many
/// to a contact that begins when the share `phase` of a step is over. The engine's own error: the
/// force begins up to a step late, and ends as late.
inline double steppedRestitution(double e, double stepsOfContact, double phase) {
    const ContactSpring press = contactSpring(stepsOfContact, e);
    double depth = -phase, separation = -1;
    for (;;) {
        depth -= separation;
        if (depth <= 0) return separation;
        separation += press.spring * depth - press.dashpot * separation;
    }
}

/// What accuracy costs: with an overlap of at most f radii at the speed v and 20 steps a contact, a
/// ball moves only this many radii in a step: pi f / 20.
inline double travelPerPenaltyStep(double f) { return std::numbers::pi * f / 20; }

}  // namespace ballpit::truth
