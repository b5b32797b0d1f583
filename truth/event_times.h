// When does it happen? The moments at which two flying balls touch and at which one reaches a
// plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "truth/vector.h"

namespace ballpit::truth {

inline constexpr double never = std::numeric_limits<double>::infinity();

/// Until two balls touch, s. `line` from one centre to the other, m; `velocity` of the other
/// against the one, m/s; `reach` the sum of the radii, m. With b = line . v, c = line^2 - reach^2
/// the root of v^2 t^2 + 2 b t + c = 0 wanted is t = c / (-b + sqrt(b^2 - v^2 c)): this form
/// subtracts nothing from its like. Balls that overlap already, by rounding, and approach collide
/// at once.
inline double timeToTouch(Vector line, Vector velocity, double reach) {
    const double b = dot(line, velocity);
    if (b >= 0) return never;  // they part
    const double c = dot(line, line) - reach * reach;
    if (c <= 0) return 0;
    const double discriminant = b * b - dot(velocity, velocity) * c;
    if (discriminant < 0) return never;  // they pass
    return c / (-b + std::sqrt(discriminant));
}

/// Until something moves outwards through a plane, s. All three numbers count outwards: its
/// `distance` to the plane, m, its `speed`, m/s, its `acceleration`, m/s^2. What lies on the plane
/// or, by rounding, behind it leaves at once if it moves outwards, and else when it comes back.
inline double timeToLeave(double distance, double speed, double acceleration) {
    const double d = std::max(distance, 0.0);
    if (acceleration == 0) return speed > 0 ? d / speed : never;
    if (speed <= 0 && acceleration < 0) return never;
    const double discriminant = speed * speed + 2 * acceleration * d;
    if (discriminant < 0) return never;  // it turns before
    const double root = std::sqrt(discriminant);
    if (speed < 0) return (-speed + root) / acceleration;  // away first, then back
    return d == 0 ? 0 : 2 * d / (speed + root);
}

}  // namespace ballpit::truth
