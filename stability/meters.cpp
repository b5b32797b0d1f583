// Implements the meters.
#include "stability/meters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/metrics.h"
#include "stability/gas_truth.h"
#include "stability/metrics.h"
#include "truth/collisions.h"

namespace ballpit::stability {

namespace {

constexpr double degree = std::numbers::pi / 180;

Vec3d difference(Vec3 a, Vec3 b) {
    return {double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z};
}

/// rad, between two vectors.
double angleBetween(Vec3d a, Vec3d b) {
    const double cosine = (a.x * b.x + a.y * b.y + a.z * b.z) / (length(a) * length(b));
    return std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// For each ball that moves at the start: the sum of value(k) over those at rest behind it.
template <class Value>
std::vector<double> sumsByBullet(const Spheres& start, Value value) {
    std::vector<double> sums;
    for (std::size_t k = 0; k < start.count(); ++k)
        if (length(start.velocities[k]) > 0)
            sums.push_back(0);
        else
            sums.back() += value(k);
    return sums;
}

}  // namespace

Meter::Meter(const Scene& scene, double dt)
    : scene_(scene), dt_(static_cast<float>(dt)), startEnergy_(energy(scene.spheres)) {}

double Meter::energy(const Spheres& now) const {
    return shadowEnergyOf(now, scene_.bounds, scene_.gravity, dt_);
}

void Meter::add(const Spheres& now, double time) {
    if (hasFailed()) return;
    verdict_ = verdictOf(now);
    if (verdict_ != Verdict::notFinite) observe(now, time);
}

Verdict Meter::verdictOf(const Spheres& now) const {
    constexpr double mostEnergy = 1.5;
    const Losses losses = lossesOf(now, scene_.bounds);
    if (losses.notFinite > 0) return Verdict::notFinite;
    if (losses.lost > 0 || hasLostOne(now)) return Verdict::lost;
    return energy(now) > mostEnergy * startEnergy_ ? Verdict::energy : Verdict::ok;
}

double ConservationMeter::errorOf(const Spheres& now) const {
    return std::max(std::abs(energy(now) / startEnergy() - 1), momentumError(scene().spheres, now));
}

void CoolingMeter::observe(const Spheres& now, double time) {
    energy_ = energy(now);
    time_ = time;
}

double CoolingMeter::error() const { return std::abs(energy_ / trueEnergy(scene(), time_) - 1); }

void OverlapMeter::observe(const Spheres& now, double) {
    const double rms = overlapOf(now, scene().bounds, scene().periodic).rms;
    squares_ += rms * rms;
    ++frames_;
}

double OverlapMeter::error() const { return std::sqrt(squares_ / std::max(1.0, frames_)); }

void RestingMeter::observe(const Spheres& now, double time) {
    if (time >= from_ || hasFailed())
        deepest_ = std::max(deepest_, overlapOf(now, scene().bounds, scene().periodic).max);
}

bool RestingMeter::hasLostOne(const Spheres& now) const { return hasFallenThrough(now); }

double CradleMeter::errorOf(const Spheres& now) const {
    const std::vector<double> truth = truth::cradleOneByOne(static_cast<int>(now.count()));
    double error = 0;
    for (std::size_t k = 0; k < now.count(); ++k) {
        const Vec3 v = now.velocities[k];
        error = std::max(error, length(Vec3d{v.x - truth[k], v.y, v.z}));
    }
    return error;
}

double AngleMeter::errorOf(const Spheres& now) const {
    const Spheres& before = scene().spheres;
    double squares = 0;
    for (std::size_t k = 0; k + 1 < now.count(); k += 2) {
        const double offset = double(before.positions[k].y) - before.positions[k + 1].y;
        const double turned =
            angleBetween(difference(before.velocities[k], before.velocities[k + 1]),
                         difference(now.velocities[k], now.velocities[k + 1]));
        const double wrong = (turned - truth::scatteringAngle(offset, 2 * ballRadius, 1)) / degree;
        squares += wrong * wrong;
    }
    return std::sqrt(squares / (0.5 * static_cast<double>(now.count())));
}

void HandedOnMeter::observe(const Spheres& now, double time) {
    momenta_ = sumsByBullet(scene().spheres, [&](std::size_t k) {
        return double(now.masses[k]) * now.velocities[k].x;
    });
    time_ = time;
}

double HandedOnMeter::error() const {
    if (momenta_.empty()) return std::numeric_limits<double>::quiet_NaN();
    const truth::Balls balls = trueEnd(scene(), time_);
    const std::vector<double> expected = sumsByBullet(
        scene().spheres, [&](std::size_t k) { return balls[k].mass * balls[k].velocity.x; });
    double squares = 0, sum = 0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        squares += (momenta_[k] - expected[k]) * (momenta_[k] - expected[k]);
        sum += expected[k];
    }
    const auto count = static_cast<double>(expected.size());
    return std::sqrt(squares / count) / (sum / count);
}

}  // namespace ballpit::stability
