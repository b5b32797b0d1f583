// Chapter 04: bodies that are near in space become near in memory.
#pragma once

#include "common/bodies.cuh"
#include "common/hole.cuh"

namespace ballpit {

/// Fills slot i of `to` with the body that the sort put there: slot sortedIndices[i] of `from`. A
/// gather: reads are scattered, but every slot is written once, by its own thread. `from` is left
/// as it is, since other threads are still reading it.
HD inline void reorderData(int i, View<const std::uint32_t> sortedIndices, BodiesView from,
                           BodiesView to) {
    // ---- hole reorder.gather (about 5 lines): Slot i gets all four fields of the body that the sort put there
    TODO_HOLE("reorder.gather");
    // ---- end of reorder.gather
}

/// The way back: writes the value of slot i to the place of the body that lies there, ids[i]. A
/// scatter, yet free of races: a body lies in one slot, so its place is written once.
template <class T>
HD void returnToBodies(int i, View<const std::uint32_t> ids, View<const T> slots, View<T> byBody) {
    // ---- hole reorder.back (about 1 line): The value of slot i goes to the place of its body
    TODO_HOLE("reorder.back");
    // ---- end of reorder.back
}

/// Bytes that reorderData moves for one body, reads and writes together.
inline std::size_t bytesMovedPerBody() {
    // ---- hole reorder.bytes (about 2 lines): Bytes that the gather of one body reads and writes
    TODO_HOLE("reorder.bytes");
    return 0;
    // ---- end of reorder.bytes
}

}  // namespace ballpit
