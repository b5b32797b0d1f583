// Owns the cells of the event-driven simulator: which balls are near which, in a box with walls or
// with periodic sides.
#pragma once

#include <cstddef>
#include <vector>

#include "truth/balls.h"

namespace ballpit::truth {

/// A cell by its coordinates; those of a neighbour may lie beyond the box until they are wrapped.
struct Cell {
    int x = 0, y = 0, z = 0;

    int& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    int operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

// A ball has six faces around it: 2 axis is the lower one, 2 axis + 1 the upper one.
inline constexpr int faceCount = 6;
inline int axisOf(int face) { return face / 2; }
inline int directionOf(int face) { return face % 2 == 1 ? 1 : -1; }

/// How deep, as a share of their distance, balls may overlap by rounding alone.
inline constexpr double roundingShare = 1e-9;

class EventCells {
public:
    /// std::invalid_argument if a ball lies outside, or if periodic sides are shorter than four
    /// diameters: a ball would then meet another and its image through both of them.
    EventCells(const Balls& balls, const Box& box, bool periodic);

    const Cell& cellOf(int ball) const { return cellOf_[static_cast<std::size_t>(ball)]; }
    const std::vector<int>& members(Cell cell) const { return members_[indexOf(cell)]; }

    /// Brings a cell beyond the periodic sides back in; false if it lies beyond a wall.
    bool wrap(Cell& cell) const;

    /// Where a face of a cell lies along its axis, m.
    double facePosition(Cell cell, int face) const;

    /// The ball goes through that face into the next cell. Returns how far that carries it along
    /// the axis, m: 0 unless it went through a periodic side and comes in on the other.
    double cross(int ball, int face);

    /// From one place to the nearest image of the other, m.
    Vector lineBetween(Vector from, Vector to) const;

    /// Is the ball's centre where the walls let it be, but for rounding?
    bool holds(const Ball& ball) const;

private:
    std::size_t indexOf(Cell c) const {
        return static_cast<std::size_t>((c.z * resolution_.y + c.y) * resolution_.x + c.x);
    }

    Box box_;
    bool periodic_;
    Cell resolution_;
    Vector cellSize_;
    std::vector<Cell> cellOf_;
    std::vector<std::vector<int>> members_;
};

}  // namespace ballpit::truth
