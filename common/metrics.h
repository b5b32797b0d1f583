// What a state is worth: energies, momenta, overlaps, losses. On the host, in double precision, in
// body order, so that the figures do not depend on the machine.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "common/pair_list.cuh"
#include "common/spheres.h"

namespace ballpit {

struct Vec3d {
    double x = 0.0, y = 0.0, z = 0.0;
};

double length(Vec3d v);

struct Metrics {
    std::size_t contacts = 0;         ///< touching pairs
    double kineticEnergy = 0.0;       ///< J: sum of m v^2 / 2
    double potentialEnergy = 0.0;     ///< J: sum of -m g.(x - lower corner)
    double shadowEnergy = 0.0;        ///< J: what semi-implicit Euler conserves in free fall
    Vec3d momentum;                   ///< kg m/s
    Vec3d angularMomentum;            ///< kg m^2/s, about the origin
    double largestPenetration = 0.0;  ///< m, between balls or into walls
    double meanPenetration = 0.0;     ///< m, over the contacts between balls
    std::size_t lost = 0;             ///< bodies whose centre is outside the world
    std::size_t notFinite = 0;        ///< bodies with an infinite or NaN coordinate
};

/// Everything about a state in a world with gravity `gravity` (m/s^2), stepped by `dt` (s).
/// The shadow energy of semi-implicit Euler is sum of m (v^2/2 - g.x + dt g.v / 2).
/// Bodies that are not finite are counted and left out of the sums. A world that is `periodic` has
/// no walls to stick in, and balls touch the nearest images of each other.
Metrics measure(const Spheres& spheres, Bounds bounds, Vec3 gravity, float dt,
                bool periodic = false);

/// m: how deep the balls of a touching pair stick in each other; in a periodic box, the nearest
/// images of them.
double penetrationOf(const Spheres& spheres, Pair pair, const std::optional<Bounds>& periodic);

/// J: the shadow energy alone, without the search for contacts.
double shadowEnergyOf(const Spheres& spheres, Bounds bounds, Vec3 gravity, float dt);

/// 64 bits over the positions and velocities in body order: equal states, and hardly any others,
/// have equal hashes.
std::uint64_t stateHash(const Spheres& spheres);

/// The same for a list of words: keys, slots, pairs.
std::uint64_t wordHash(std::span<const std::uint32_t> words);

/// The hash as its 16 digits.
std::string hashText(std::uint64_t hash);

}  // namespace ballpit
