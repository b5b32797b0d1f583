// Small vectors for positions, velocities and cells. Only + - * / and sqrtf, so that the CPU and
// the GPU give the same bits.
#pragma once

#include "common/hd.h"

#include <cmath>

namespace ballpit {

/// Three floats: a position in metres, a velocity in m/s, a colour in [0, 1].
struct Vec3 {
    float x = 0.0f, y = 0.0f, z = 0.0f;
};

/// Four floats in one 16-byte load. The engine packs a scalar beside a vector: position and
/// radius, velocity and mass.
struct alignas(16) Vec4 {
    float x = 0.0f, y = 0.0f, z = 0.0f, w = 0.0f;
};

/// Cell coordinates in a grid.
struct Int3 {
    int x = 0, y = 0, z = 0;
};

HD inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HD inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HD inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
HD inline Vec3 operator*(float s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
HD inline Vec3 operator*(Vec3 a, float s) { return s * a; }
HD inline Vec3 operator/(Vec3 a, float s) { return {a.x / s, a.y / s, a.z / s}; }
HD inline Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
HD inline Vec3& operator-=(Vec3& a, Vec3 b) { return a = a - b; }
HD inline bool operator==(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// The sum runs x, y, z: a fixed order is part of the exactness contract.
HD inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HD inline float lengthSquared(Vec3 a) { return dot(a, a); }
HD inline float length(Vec3 a) { return sqrtf(lengthSquared(a)); }
HD inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

HD inline Vec3 xyz(Vec4 a) { return {a.x, a.y, a.z}; }
HD inline Vec4 withW(Vec3 a, float w) { return {a.x, a.y, a.z, w}; }

/// std::min and std::max are not device functions, and fminf is a slow call on a CPU. A NaN in
/// `a` yields `b`, on every machine.
HD inline float minimum(float a, float b) { return a < b ? a : b; }
HD inline float maximum(float a, float b) { return a > b ? a : b; }

/// An axis-aligned box in metres: the world's walls.
struct Bounds {
    Vec3 lower, upper;
};

HD inline Vec3 extent(Bounds box) { return box.upper - box.lower; }

/// NaN fails every comparison, so a body that is not finite is not inside.
HD inline bool contains(Bounds box, Vec3 p) {
    return p.x >= box.lower.x && p.x <= box.upper.x && p.y >= box.lower.y && p.y <= box.upper.y &&
           p.z >= box.lower.z && p.z <= box.upper.z;
}

/// True if no component is infinite or NaN: x - x is 0 for finite numbers and NaN otherwise.
HD inline bool isFinite(Vec3 a) {
    return a.x - a.x == 0.0f && a.y - a.y == 0.0f && a.z - a.z == 0.0f;
}

}  // namespace ballpit
