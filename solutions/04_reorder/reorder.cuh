// Chapter 04: bodies that are near in space become near in memory.
#pragma once

#include "common/bodies.cuh"
//@starter #include "common/hole.cuh"

namespace ballpit {

/// Fills slot i of `to` with the body that the sort put there: slot sortedIndices[i] of `from`. A
/// gather: reads are scattered, but every slot is written once, by its own thread. `from` is left
/// as it is, since other threads are still reading it.
HD inline void reorderData(int i, View<const std::uint32_t> sortedIndices, BodiesView from,
                           BodiesView to) {
    //@hole reorder.gather lines=5 "Slot i gets all four fields of the body that the sort put there"
    //@starter TODO_HOLE("reorder.gather");
    const std::uint32_t source = sortedIndices[i];
    to.positions[i] = from.positions[source];
    to.velocities[i] = from.velocities[source];
    to.restitutions[i] = from.restitutions[source];
    to.ids[i] = from.ids[source];
    //@end
}

/// The way back: writes the value of slot i to the place of the body that lies there, ids[i]. A
/// scatter, yet free of races: a body lies in one slot, so its place is written once.
template <class T>
HD void returnToBodies(int i, View<const std::uint32_t> ids, View<const T> slots, View<T> byBody) {
    //@hole reorder.back lines=1 "The value of slot i goes to the place of its body"
    //@starter TODO_HOLE("reorder.back");
    byBody[ids[i]] = slots[i];
    //@end
}

/// Bytes that reorderData moves for one body, reads and writes together.
inline std::size_t bytesMovedPerBody() {
    //@hole reorder.bytes lines=2 "Bytes that the gather of one body reads and writes"
    //@starter TODO_HOLE("reorder.bytes");
    //@starter return 0;
    const std::size_t body = 2 * sizeof(Vec4) + sizeof(float) + sizeof(std::uint32_t);
    return sizeof(std::uint32_t) + 2 * body;  // the index once; the body is read and written
    //@end
}

}  // namespace ballpit
