// Closed forms of a gas of hard spheres: pressure, collision rate, cooling, distribution of speeds.
// Symbols: number density rho (1/m^3), diameter sigma (m), share of volume eta = pi rho sigma^3 /
// 6, temperature T = m <v^2> / 3 (J), mass m (kg), restitution e.
#pragma once

#include <cmath>
#include <numbers>

namespace ballpit::truth {

inline double volumeShare(double rho, double sigma) {
    return std::numbers::pi / 6 * rho * sigma * sigma * sigma;
}

/// Z = P V / (N T) = (1 + eta + eta^2 - eta^3) / (1 - eta)^3 (Carnahan and Starling 1969): within
/// about 0.3 % of simulations for the whole fluid, eta < 0.49.
inline double carnahanStarling(double eta) {
    return (1 + eta + eta * eta - eta * eta * eta) / std::pow(1 - eta, 3);
}

/// How much denser than the mean the gas is around a ball, at contact: g(sigma) that belongs to it,
/// by the virial theorem Z = 1 + 4 eta g.
inline double contactValue(double eta) { return (1 - eta / 2) / std::pow(1 - eta, 3); }

/// Enskog's rate of collisions of one ball, 1/s: 4 sqrt(pi) rho sigma^2 g(sigma) sqrt(T / m).
inline double enskogRate(double rho, double sigma, double T, double m) {
    return 4 * std::sqrt(std::numbers::pi) * rho * sigma * sigma *
           contactValue(volumeShare(rho, sigma)) * std::sqrt(T / m);
}

/// Mean time between two collisions of one ball, s.
inline double enskogMeanFreeTime(double rho, double sigma, double T, double m) {
    return 1 / enskogRate(rho, sigma, T, m);
}

/// Haff's time, s: what an inelastic gas with the collision rate `rate` at the start needs to cool
/// to a quarter: 6 / ((1 - e^2) rate).
inline double haffTime(double e, double rate) { return 6 / ((1 - e * e) * rate); }

/// T(t) / T(0) = (1 + t / haffTime)^-2, while the gas stays uniform (Haff 1983).
inline double haffCooling(double t, double haffTime) { return std::pow(1 + t / haffTime, -2); }

// Maxwell and Boltzmann: every component of the velocity is normal with the variance T / m.

/// <v> = sqrt(8 T / (pi m)), m/s.
inline double meanSpeed(double T, double m) { return std::sqrt(8 * T / (std::numbers::pi * m)); }

/// <v^4> / <v^2>^2.
inline constexpr double fourthMomentRatio = 5.0 / 3.0;

/// Share of components below v, m/s.
inline double componentShareBelow(double v, double T, double m) {
    return 0.5 * std::erfc(-v / std::sqrt(2 * T / m));
}

/// Share of balls slower than v >= 0, m/s.
inline double speedShareBelow(double v, double T, double m) {
    const double x = v / std::sqrt(2 * T / m);
    return std::erf(x) - 2 / std::sqrt(std::numbers::pi) * x * std::exp(-x * x);
}

}  // namespace ballpit::truth
