// How wrong a run is, in numbers without units, so that scenes of any size and any units can be
// compared. On the host, in double precision, in body order. Symbols: r radius, m mass, v velocity,
// N balls, T granular temperature (a third of m v^2 a ball), e restitution.
#pragma once

#include <cstddef>
#include <vector>

#include "12_speed_and_accuracy/errors.h"
#include "common/metrics.h"

namespace ballpit::stability {

/// How deep balls stick in each other and in walls.
struct Overlap {
    double rms = 0;            ///< sqrt(sum over all contacts of d^2 / N) / mean r; d: overlap in m
    double max = 0;            ///< deepest d / mean r
    std::size_t contacts = 0;  ///< of two balls
    std::size_t wallContacts = 0;  ///< of a ball and a wall
};
/// SimBenchmark's sum of squares, divided by N. Bodies that are not finite are left out.
/// A world that is `periodic` has no walls.
Overlap overlapOf(const Spheres& spheres, Bounds walls, bool periodic = false);

/// |p - p0| / sqrt(2 E0 M), with p the momentum, E0 the kinetic energy at the start, M the mass of
/// all: 1 is as much momentum as the balls have if they all fly the same way.
double momentumError(const Spheres& before, const Spheres& after);

/// 1 - given / expected: the share of the impulses that should have been and were not.
inline double missedShare(double given, double expected) { return 1 - given / expected; }

/// Bodies whose centre is outside the walls, and bodies that are not finite.
struct Losses {
    std::size_t lost, notFinite;
};
Losses lossesOf(const Spheres& spheres, Bounds walls);

// Gases.

/// J: a third of m v^2 a ball.
double temperatureOf(const Spheres& spheres);

/// s: the mean time between two collisions of one ball, N t / (2 C): C collisions (of two balls) in
/// `time` s.
double meanFreeTime(std::size_t balls, double time, double collisions);

/// Z = P V / (N T) of equal elastic balls, from their collisions: 1 + sigma sqrt(pi m / T) / (6 t),
/// with the mean free time t. (Virial theorem: each collision adds sigma m v_n, and <v_n> is
/// sqrt(pi T / m).)
double compressibilityFrom(double meanFreeTime, double sigma, double mass, double temperature);

/// The largest distance between the distribution of all velocity components and Maxwell's at the
/// same temperature (Kolmogorov and Smirnov). Equal masses.
double maxwellDistance(const Spheres& spheres);

/// T(t) / T(0) over what Haff's law says after `time` s: 1 if it is right.
double haffRatio(double temperature, double startTemperature, double time, double haffTime);

// Heaps.

/// Does a ball of a column lie lower than the one below it was? Bodies are numbered from the floor.
bool hasFallenThrough(const Spheres& spheres);

/// The share of the slab between the heights `low` and `high`, wall to wall, that is ball.
double packingFraction(const Spheres& spheres, Bounds walls, double low, double high);

/// Contacts a ball, 2 C / N, where balls count as touching up to a gap of `slack` mean radii.
double coordination(const Spheres& spheres, double slack);

/// sqrt(<v^2>) / (g dt), g in m/s^2, dt in s: at rest, what gravity adds to a velocity in a step is
/// the least that a scheme has to deal with.
double velocityNoise(const Spheres& spheres, double g, double dt);

/// What the floor (and the ceiling) gave in `time` s, over the weight of all: by the momentum that
/// gravity would have given and did not. 1 for all that stands; it says nothing about how.
double floorLoad(const Spheres& before, const Spheres& after, double g, double time);

// Runs.

/// m: the largest distance of one body in two runs. 0 does not say that the bits are equal.
double largestDistance(const Spheres& a, const Spheres& b);
/// Whether positions and velocities are the same bits.
bool sameBits(const Spheres& a, const Spheres& b);

/// What a run costs.
struct Cost {
    double milliseconds = 0;  ///< wall time of the steps
    double simulatedSeconds = 0;
    double pairVisits = 0;  ///< listed pairs times passes: a cost without a machine
    double millisecondsASecond() const { return milliseconds / simulatedSeconds; }
    double pairVisitsASecond() const { return pairVisits / simulatedSeconds; }
    double realTimeFactor() const { return 1000 * simulatedSeconds / milliseconds; }
};

}  // namespace ballpit::stability
