// Implements the metrics.
#include "stability/metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/host_pairs.h"
#include "truth/kinetic_theory.h"
#include "truth/statistics.h"

namespace ballpit::stability {

namespace {

bool finite(const Spheres& s, std::size_t k) {
    return isFinite(s.positions[k]) && isFinite(s.velocities[k]);
}

Vec3d between(Vec3 from, Vec3 to) {
    return {double(to.x) - from.x, double(to.y) - from.y, double(to.z) - from.z};
}

double squared(Vec3 v) { return double(v.x) * v.x + double(v.y) * v.y + double(v.z) * v.z; }

double meanRadius(const Spheres& spheres) {
    double sum = 0;
    for (const float radius : spheres.radii) sum += radius;
    return sum / static_cast<double>(spheres.count());
}

/// Calls visit(overlap in m) for each wall that ball k sticks in.
template <class Visit>
void visitWalls(const Spheres& s, std::size_t k, Bounds walls, Visit visit) {
    const Vec3 p = s.positions[k];
    for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z})
        for (const double gap :
             {double(p.*axis) - walls.lower.*axis, double(walls.upper.*axis) - p.*axis})
            if (gap < s.radii[k]) visit(s.radii[k] - gap);
}

/// The mean of m v^2 over the balls.
double meanOfMassTimesSquare(const Spheres& s) {
    double sum = 0;
    for (std::size_t k = 0; k < s.count(); ++k) sum += s.masses[k] * squared(s.velocities[k]);
    return sum / static_cast<double>(s.count());
}

/// m^3: the part of a ball that lies below the plane `depth` above its lowest point.
double capVolume(double radius, double depth) {
    const double h = std::clamp(depth, 0.0, 2 * radius);
    return std::numbers::pi * h * h * (3 * radius - h) / 3;
}

}  // namespace

Overlap overlapOf(const Spheres& all, Bounds walls, bool periodic) {
    Spheres spheres;
    for (std::size_t k = 0; k < all.count(); ++k)
        if (finite(all, k)) spheres.add(all.positions[k], {}, all.radii[k], 1, 0);
    Overlap overlap;
    std::vector<double> depths;
    for (std::size_t k = 0; k < spheres.count() && !periodic; ++k)
        visitWalls(spheres, k, walls, [&](double depth) {
            ++overlap.wallContacts;
            depths.push_back(depth);
        });
    const std::optional<Bounds> box = periodic ? std::optional(walls) : std::nullopt;
    for (const Pair pair : findPairsOnHost(spheres, box)) {
        ++overlap.contacts;
        depths.push_back(penetrationOf(spheres, pair, box));
    }
    if (depths.empty()) return overlap;
    overlap.rms = rmsOverlap(depths, spheres.count(), meanRadius(spheres));
    overlap.max = *std::max_element(depths.begin(), depths.end()) / meanRadius(spheres);
    return overlap;
}

double momentumError(const Spheres& before, const Spheres& after) {
    const Metrics start = measure(before, {}, {}, 0), end = measure(after, {}, {}, 0);
    double mass = 0;
    for (const float m : before.masses) mass += m;
    const Vec3d change{end.momentum.x - start.momentum.x, end.momentum.y - start.momentum.y,
                       end.momentum.z - start.momentum.z};
    return length(change) / std::sqrt(2 * start.kineticEnergy * mass);
}

Losses lossesOf(const Spheres& spheres, Bounds walls) {
    Losses losses{0, 0};
    for (std::size_t k = 0; k < spheres.count(); ++k) {
        if (!finite(spheres, k))
            ++losses.notFinite;
        else if (!contains(walls, spheres.positions[k]))
            ++losses.lost;
    }
    return losses;
}

double temperatureOf(const Spheres& spheres) { return meanOfMassTimesSquare(spheres) / 3; }

double meanFreeTime(std::size_t balls, double time, double collisions) {
    return static_cast<double>(balls) * time / (2 * collisions);
}

double compressibilityFrom(double meanFreeTime, double sigma, double mass, double temperature) {
    return 1 + sigma * std::sqrt(std::numbers::pi * mass / temperature) / (6 * meanFreeTime);
}

double maxwellDistance(const Spheres& spheres) {
    std::vector<double> components;
    for (const Vec3 v : spheres.velocities) components.insert(components.end(), {v.x, v.y, v.z});
    const double T = temperatureOf(spheres), m = spheres.masses[0];
    return truth::kolmogorovDistance(components,
                                     [&](double v) { return truth::componentShareBelow(v, T, m); });
}

double haffRatio(double temperature, double startTemperature, double time, double haffTime) {
    return temperature / startTemperature / truth::haffCooling(time, haffTime);
}

bool hasFallenThrough(const Spheres& s) {
    for (std::size_t k = 1; k < s.count(); ++k)
        if (s.positions[k].y <= s.positions[k - 1].y) return true;
    return false;
}

double packingFraction(const Spheres& spheres, Bounds walls, double low, double high) {
    double volume = 0;
    for (std::size_t k = 0; k < spheres.count(); ++k) {
        const double radius = spheres.radii[k], bottom = spheres.positions[k].y - radius;
        volume += capVolume(radius, high - bottom) - capVolume(radius, low - bottom);
    }
    const Vec3 size = extent(walls);
    return volume / (double(size.x) * size.z * (high - low));
}

double coordination(const Spheres& spheres, double slack) {
    Spheres grown = spheres;
    const auto growth = static_cast<float>(0.5 * slack * meanRadius(spheres));
    for (float& radius : grown.radii) radius += growth;
    return 2.0 * static_cast<double>(findPairsOnHost(grown).size()) /
           static_cast<double>(spheres.count());
}

double velocityNoise(const Spheres& spheres, double g, double dt) {
    double sum = 0;
    for (const Vec3 v : spheres.velocities) sum += squared(v);
    return std::sqrt(sum / static_cast<double>(spheres.count())) / (g * dt);
}

double floorLoad(const Spheres& before, const Spheres& after, double g, double time) {
    double mass = 0, gained = 0;
    for (std::size_t k = 0; k < after.count(); ++k) {
        const double m = after.masses[k];
        mass += m;
        gained += m * (double(after.velocities[k].y) - before.velocities[k].y);
    }
    return 1 + gained / (mass * g * time);
}

double largestDistance(const Spheres& a, const Spheres& b) {
    double largest = 0;
    for (std::size_t k = 0; k < a.count(); ++k)
        largest = std::max(largest, length(between(a.positions[k], b.positions[k])));
    return largest;
}

bool sameBits(const Spheres& a, const Spheres& b) { return stateHash(a) == stateHash(b); }

}  // namespace ballpit::stability
