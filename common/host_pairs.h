// All touching pairs, found on the host without the engine: what metrics are computed from, and an
// independent check of the broad phase in large scenes.
#pragma once

#include <optional>
#include <vector>

#include "common/pair_list.cuh"
#include "common/spheres.h"

namespace ballpit {

/// All pairs of bodies nearer than the sum of their radii, first < second, sorted. Cells of the
/// largest diameter, in a sorted list with no bounds: memory does not depend on the world.
/// In a box that is `periodic`, whose edges are three of these diameters at least, balls touch the
/// nearest image of each other.
std::vector<Pair> findPairsOnHost(const Spheres& spheres,
                                  const std::optional<Bounds>& periodic = std::nullopt);

}  // namespace ballpit
