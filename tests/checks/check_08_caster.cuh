// The oracle of chapter 08: a ray caster in double precision that asks every pixel for the nearest
// ball. It shares no line with the renderer.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "common/camera.h"
#include "common/frame.h"

namespace ballpit::check {

struct Triple {
    double x = 0, y = 0, z = 0;
};

inline Triple operator+(Triple a, Triple b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Triple operator-(Triple a, Triple b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Triple operator*(double s, Triple a) { return {s * a.x, s * a.y, s * a.z}; }
inline double inner(Triple a, Triple b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Triple outer(Triple a, Triple b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Triple direction(Triple a) { return (1 / std::sqrt(inner(a, a))) * a; }
inline Triple triple(Vec3 a) { return {a.x, a.y, a.z}; }

struct Ball08 {
    Vec3 position;
    float radius;
    Vec3 color;
};

/// A mistake put into the oracle, to name what a student's picture looks like.
struct Twist {
    double radiusFactor = 1;
    bool farSide = false;       ///< where the ray leaves the sphere
    bool normalInward = false;  ///< normals point into the ball
    bool normalToEye = false;   ///< every normal faces the eye
    bool lastDrawn = false;     ///< no depth test: the ball drawn last is seen
    bool centerDepth = false;   ///< compared by the depth of centres
    bool upsideDown = false, leftRight = false;
};

constexpr int nobody = -1;

/// What one pixel sees.
struct Seen {
    int ball = nobody;
    Triple color;  // 0 to 1
};

class RayCaster {
public:
    RayCaster(const Camera& camera, int width, int height, std::vector<Ball08> balls,
              Twist twist = {})
        : balls_(std::move(balls)), twist_(twist), width_(width), height_(height) {
        eye_ = triple(camera.eye);
        forward_ = direction(triple(camera.target) - eye_);
        right_ = direction(outer(forward_, {0, 1, 0}));
        up_ = outer(right_, forward_);
        constexpr double pi = 3.14159265358979323846;
        tangent_ = std::tan(camera.verticalFieldOfView / 2.0 * pi / 180.0);
    }

    /// The ray through a place of the frame: pixel (0, 0) is the top left one.
    Seen through(double x, double y) const {
        double across = (2 * x / width_ - 1) * tangent_ * width_ / height_;
        double along = (1 - 2 * y / height_) * tangent_;
        if (twist_.leftRight) across = -across;
        if (twist_.upsideDown) along = -along;
        return follow(direction(forward_ + across * right_ + along * up_));
    }

    /// All pixels through their centres, row by row.
    std::vector<Seen> picture() const {
        std::vector<Seen> pixels;
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) pixels.push_back(through(x + 0.5, y + 0.5));
        return pixels;
    }

private:
    Seen follow(Triple ray) const {
        Seen seen;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < balls_.size(); ++k) {
            const Triple center = triple(balls_[k].position) - eye_;
            const double radius = twist_.radiusFactor * balls_[k].radius;
            // |t ray - center|^2 = radius^2
            const double b = inner(ray, center);
            const double under = b * b - inner(center, center) + radius * radius;
            if (under < 0) continue;
            const double t = b + (twist_.farSide ? 1 : -1) * std::sqrt(under);
            if (t <= 0) continue;
            const double rank = twist_.lastDrawn     ? -static_cast<double>(k)
                                : twist_.centerDepth ? inner(center, forward_)
                                                     : t;
            if (rank >= nearest) continue;
            nearest = rank;
            seen.ball = static_cast<int>(k);
            Triple normal = (1 / radius) * (t * ray - center);
            if (twist_.normalInward) normal = -1.0 * normal;
            if (twist_.normalToEye) normal = -1.0 * forward_;
            seen.color = lit(normal, -1.0 * ray, triple(balls_[k].color));
        }
        return seen;
    }

    /// Phong's model with the numbers of solutions/08_sphere_rendering/shading.h.
    static Triple lit(Triple normal, Triple toEye, Triple color) {
        const Triple lamp{-0.36, 0.80, 0.48};
        const double facing = std::max(inner(normal, lamp), 0.0);
        const double toSky = 0.5 + 0.5 * normal.y;
        const Triple ambient =
            toSky * Triple{0.42, 0.45, 0.50} + (1 - toSky) * Triple{0.23, 0.22, 0.23};
        const double fill = 0.14 * std::max(inner(normal, toEye), 0.0);
        const Triple light =
            ambient + facing * Triple{0.62, 0.6014, 0.5642} + Triple{fill, fill, fill};
        const Triple mirrored = 2 * inner(normal, lamp) * normal - lamp;
        const double shine = 0.38 * std::pow(std::max(inner(mirrored, toEye), 0.0), 48.0);
        const auto whole = [&](double c, double l) { return std::min(c * l + shine, 1.0); };
        return {whole(color.x, light.x), whole(color.y, light.y), whole(color.z, light.z)};
    }

    std::vector<Ball08> balls_;
    Twist twist_;
    int width_, height_;
    Triple eye_, forward_, right_, up_;
    double tangent_;
};

}  // namespace ballpit::check
