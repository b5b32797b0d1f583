// Closed forms of one ball's fall and bouncing: in nature, and as semi-implicit Euler steps have
// it.
#pragma once

#include <cmath>

namespace ballpit::truth {

/// Height (m) and upward speed (m/s) of one ball.
struct Fall {
    double height, speed;
};

/// After n steps v <- d (v - g dt), y <- y + v dt, exactly. g: m/s^2, downwards; d: the factor that
/// damping leaves of a velocity each step, 1 for none. With A = d + d^2 + ... + d^n:
///     v_n = d^n v0 - g dt A,    y_n = y0 + v0 dt A - g dt^2 d (n - A) / (1 - d)
inline Fall semiImplicitFall(Fall start, double g, double dt, double d, int n) {
    if (d == 1)
        return {start.height + n * start.speed * dt - g * dt * dt * n * (n + 1.0) / 2,
                start.speed - n * g * dt};
    const double power = std::pow(d, n);
    const double sum = d * (1 - power) / (1 - d);
    return {start.height + start.speed * dt * sum - g * dt * dt * d * (n - sum) / (1 - d),
            power * start.speed - g * dt * sum};
}

/// Galilei's fall after t s.
inline Fall continuousFall(Fall start, double g, double t) {
    return {start.height + start.speed * t - 0.5 * g * t * t, start.speed - g * t};
}

/// How far semi-implicit steps of dt lie below it after t s, m: first order in dt.
inline double semiImplicitFallError(double g, double t, double dt) { return -0.5 * g * t * dt; }

/// What semi-implicit Euler keeps exactly in flight in place of the energy, J/kg:
///     H = v^2 / 2 + g y - g dt v / 2
inline double shadowEnergy(Fall now, double g, double dt) {
    return 0.5 * now.speed * now.speed + g * now.height - 0.5 * g * dt * now.speed;
}

/// Height of the centre, m, at the top of bounce k of a ball of radius r dropped from h0 (bounce
/// 0): h_k = (h0 - r) e^(2k) + r (MFIX-DEM's verification manual, case DEM02, equation 4.11).
inline double bounceHeight(double h0, double r, double e, int k) {
    return (h0 - r) * std::pow(e, 2 * k) + r;
}

/// When that ball has come to rest, s: infinitely many bounces in sqrt(2 (h0 - r) / g) (1+e)/(1-e).
inline double bouncingTime(double h0, double r, double g, double e) {
    return std::sqrt(2 * (h0 - r) / g) * (1 + e) / (1 - e);
}

/// Mean share of its energy that an elastic ball loses in a bounce at `speed` m/s, since the wall
/// is felt only at the end of a step. Position put back on the wall: H changes by g d - g dt v with
/// the depth d uniform in 0..v dt, on average -g dt v / 2. Left where it is: by -g dt v.
inline double bounceLoss(double g, double dt, double speed, bool putBack) {
    return (putBack ? 1 : 2) * g * dt / speed;
}

}  // namespace ballpit::truth
