// Motion for bodies that only a chapter's film moves: each on its own straight line.
#pragma once

#include "common/random.h"
#include "common/spheres.h"

namespace ballpit {

/// Random velocities, along each axis up to `fastest` m/s both ways.
void stir(Spheres& spheres, Vec3 fastest, std::uint64_t seed);

/// Moves all bodies along their velocities, for a sixtieth of a second. They pass through each
/// other, and turn back where their centres would leave `world`.
void drift(Spheres& spheres, Bounds world);

/// Lets bodies of these radii grow one after the other, by number, so that all are there at three
/// quarters of a film. `share` of it is over.
void showFirst(Spheres& spheres, const std::vector<float>& radii, float share);

}  // namespace ballpit
