// Closed forms of single collisions, and what detecting them only at the end of a step costs.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace ballpit::truth {

/// Speeds of two balls on a line, m/s.
struct LineSpeeds {
    double first, second;
};

/// Head-on collision of masses m1, m2 (kg) with speeds v1 > v2 (m/s), restitution e, from the two
/// laws it must obey: momentum m1 v1 + m2 v2 stays, and v2' - v1' = e (v1 - v2).
inline LineSpeeds headOn(double m1, double v1, double m2, double v2, double e) {
    const double common = (m1 * v1 + m2 * v2) / (m1 + m2);
    const double rebound = e * (v1 - v2) / (m1 + m2);
    return {common - m2 * rebound, common + m1 * rebound};
}

/// Kinetic energy that a collision takes, J: m_eff (1 - e^2) v_n^2 / 2, v_n the approach speed.
inline double energyLost(double m1, double m2, double approachSpeed, double e) {
    return 0.5 * m1 * m2 / (m1 + m2) * (1 - e * e) * approachSpeed * approachSpeed;
}

/// By how much the relative velocity turns, rad, when it misses the centre by `impactParameter` b
/// (m) and the balls touch at the distance sigma (m). The normal makes the angle a with it, with
/// sin a = b / sigma; the tangential part stays, the normal part comes back times e. For e = 1 it
/// is 2 acos(b / sigma).
inline double scatteringAngle(double impactParameter, double sigma, double e) {
    const double a = std::asin(impactParameter / sigma);
    return std::numbers::pi - a - std::atan2(std::sin(a), e * std::cos(a));
}

/// E'/E after one plain sum of pair impulses: a hub of mass m_h runs into k resting spokes of mass
/// m_s at once, evenly around its way and each at the cosine c to it. S = k c^2, B = m_s / (m_s +
/// m_h):
///     E'/E = 1 - (1 + e) B S [2 - (1 + e) (B S + 1 - B)]
inline double hubAndSpokesEnergy(double e, double S, double B) {
    return 1 - (1 + e) * B * S * (2 - (1 + e) * (B * S + 1 - B));
}

/// Such a sum never gains energy while (1 + e) (1 + B (S - 1)) <= 2.
inline bool plainSumKeepsEnergy(double e, double S, double B) {
    return (1 + e) * (1 + B * (S - 1)) <= 2;
}

/// Newton's cradle of `count` equal elastic balls, the first coming with 1 m/s: one contact after
/// the other hands the whole speed on.
inline std::vector<double> cradleOneByOne(int count) {
    std::vector<double> speeds(static_cast<std::size_t>(count), 0.0);
    speeds.back() = 1;
    return speeds;
}

/// The same by all contacts at once, each asked to end with -e times the approach it began with:
/// all but the first leave with the same w, the first with w - e, and momentum gives w = (1 + e) /
/// n. Momentum and, for e = 1, energy are kept, and yet no cradle does this.
inline std::vector<double> cradleAtOnce(int count, double e) {
    const double together = (1 + e) / count;
    std::vector<double> speeds(static_cast<std::size_t>(count), together);
    speeds.front() = together - e;
    return speeds;
}

/// Share of impacts that get an impulse when contacts are looked for only at the end of each step.
/// `travel` u = v_rel dt / sigma. With the impact parameter uniform over the disc and the phase
/// uniform, the balls approach within contact for sigma sqrt(q), q uniform in 0..1; a step ends in
/// there with the probability min(1, sqrt(q) / u).
inline double impulseAppliedShare(double travel) {
    return travel <= 1 ? 1 - travel * travel / 3 : 2 / (3 * travel);
}

/// Root mean square error of the scattering angle, rad, since the normal is taken late: up to v_rel
/// dt after contact. First order in s = v_rel dt / r: the angle errs by 2 x b / sigma^2 at the
/// depth x, with <x^2> = (v_rel dt)^2 / 3 and <b^2> = sigma^2 / 2.
inline double lateNormalAngleError(double s) { return s / std::sqrt(6.0); }

/// Share of the momentum along the line of flight that the late normal leaves untransferred, first
/// order in s = v_rel dt / r.
inline double lateNormalMomentumDeficit(double s) { return 4 * s / 15; }

}  // namespace ballpit::truth
