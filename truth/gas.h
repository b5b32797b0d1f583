// Starting states of gases: equal balls on a lattice in a cube, with velocities drawn by Maxwell
// and Boltzmann, no momentum, and exactly the temperature asked for.
#pragma once

#include <cstdint>
#include <vector>

#include "truth/balls.h"

namespace ballpit::truth {

struct Gas {
    Balls balls;
    Box box;
};

struct GasSettings {
    int cellsPerSide = 5;  ///< of a face-centred cubic lattice with four balls a cell
    double density = 0.5;  ///< balls a volume of one diameter cubed; the lattice is full at sqrt(2)
    double radius = 0.5;   ///< m
    double mass = 1;       ///< kg
    double restitution = 1;
    double temperature = 1;  ///< J
    std::uint64_t seed = 1;
};

/// 4 n^3 balls; no two overlap while density <= sqrt(2). The box begins at the origin. Between
/// walls
/// (`walled`) the lattice is shrunk so that the outer balls fit in, which wants some room.
Gas latticeGas(const GasSettings& settings, bool walled = false);

}  // namespace ballpit::truth
