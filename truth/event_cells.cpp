// Implements the cells of the event-driven simulator.
#include "truth/event_cells.h"

#include <stdexcept>

namespace ballpit::truth {

EventCells::EventCells(const Balls& balls, const Box& box, bool periodic)
    : box_(box), periodic_(periodic) {
    double largest = 0;
    for (const Ball& ball : balls) largest = std::max(largest, ball.radius);
    // Not many more cells than balls: an empty world would else be crossed face by face.
    const int most = 4 + static_cast<int>(std::cbrt(static_cast<double>(balls.size())));
    for (int axis = 0; axis < 3; ++axis) {
        const double side = box.upper[axis] - box.lower[axis];
        resolution_[axis] = static_cast<int>(std::clamp(side / (2 * largest), 1.0, 1.0 * most));
        if (periodic && resolution_[axis] < 4)
            throw std::invalid_argument("periodic sides must be four diameters long or more");
        cellSize_[axis] = side / resolution_[axis];
    }
    members_.resize(static_cast<std::size_t>(resolution_.x * resolution_.y * resolution_.z));
    for (const Ball& ball : balls) {
        if (!holds(ball)) throw std::invalid_argument("a ball lies outside the box");
        Cell cell;
        for (int axis = 0; axis < 3; ++axis) {
            const double inside = ball.position[axis] - box.lower[axis];
            cell[axis] =
                std::clamp(static_cast<int>(inside / cellSize_[axis]), 0, resolution_[axis] - 1);
        }
        members_[indexOf(cell)].push_back(static_cast<int>(cellOf_.size()));
        cellOf_.push_back(cell);
    }
}

bool EventCells::wrap(Cell& cell) const {
    for (int axis = 0; axis < 3; ++axis) {
        if (cell[axis] >= 0 && cell[axis] < resolution_[axis]) continue;
        if (!periodic_) return false;
        cell[axis] = (cell[axis] + resolution_[axis]) % resolution_[axis];
    }
    return true;
}

double EventCells::facePosition(Cell cell, int face) const {
    const int axis = axisOf(face);
    const int line = cell[axis] + (directionOf(face) > 0 ? 1 : 0);
    return box_.lower[axis] + cellSize_[axis] * line;
}

double EventCells::cross(int ball, int face) {
    const int axis = axisOf(face);
    Cell& cell = cellOf_[static_cast<std::size_t>(ball)];
    std::vector<int>& left = members_[indexOf(cell)];
    left.erase(std::find(left.begin(), left.end(), ball));
    cell[axis] += directionOf(face);
    const int unwrapped = cell[axis];
    wrap(cell);
    members_[indexOf(cell)].push_back(ball);
    return cellSize_[axis] * (cell[axis] - unwrapped);
}

Vector EventCells::lineBetween(Vector from, Vector to) const {
    Vector line = to - from;
    if (!periodic_) return line;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = box_.upper[axis] - box_.lower[axis];
        line[axis] -= side * std::round(line[axis] / side);
    }
    return line;
}

bool EventCells::holds(const Ball& ball) const {
    for (int axis = 0; axis < 3; ++axis) {
        const double side = box_.upper[axis] - box_.lower[axis];
        const double margin = (periodic_ ? 0 : ball.radius) - roundingShare * side;
        if (!(ball.position[axis] >= box_.lower[axis] + margin &&
              ball.position[axis] <= box_.upper[axis] - margin))
            return false;
    }
    return true;
}

}  // namespace ballpit::truth
