// Vectors and a box in double precision: the arithmetic of everything in truth/.
#pragma once

#include <cmath>

namespace ballpit::truth {

/// Three doubles: a position in m or a velocity in m/s.
struct Vector {
    double x = 0, y = 0, z = 0;

    double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vector& operator+=(Vector& a, Vector b) { return a = a + b; }
inline Vector& operator-=(Vector& a, Vector b) { return a = a - b; }

inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(Vector a) { return std::sqrt(dot(a, a)); }

inline bool isFinite(Vector a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// An axis-aligned box, m: four walls, floor and ceiling, or the cell of a periodic world.
struct Box {
    Vector lower, upper;
};

}  // namespace ballpit::truth
