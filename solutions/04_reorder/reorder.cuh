// Chapter 04: bodies that are near in space become near in memory.
#pragma once

#include "common/bodies.cuh"

namespace ballpit {

/// Fills slot i of `to` with the body that the sort put there. A gather: reads are scattered, but
/// every slot is written once, by its own thread.
HD inline void reorderData(int i, View<const std::uint32_t> sortedIndices, BodiesView from,
                           BodiesView to) {
    const std::uint32_t source = sortedIndices[i];
    to.positions[i] = from.positions[source];
    to.velocities[i] = from.velocities[source];
    to.restitutions[i] = from.restitutions[source];
    to.ids[i] = from.ids[source];
}

}  // namespace ballpit
