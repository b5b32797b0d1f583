// Metrics and the state hash.
#include "common/metrics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

#include "common/bodies.cuh"
#include "common/host_pairs.h"

namespace ballpit {

namespace {

double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3d widen(Vec3 v) { return {v.x, v.y, v.z}; }
Vec3d minus(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
void addScaled(Vec3d& sum, double s, Vec3d v) {
    sum.x += s * v.x, sum.y += s * v.y, sum.z += s * v.z;
}
Vec3d cross(Vec3d a, Vec3d b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// How far a ball sticks into the nearest wall, m; negative if it is clear of all.
double wallPenetration(Vec3d p, double radius, Bounds walls) {
    const Vec3d lower = widen(walls.lower), upper = widen(walls.upper);
    return radius - std::min({p.x - lower.x, p.y - lower.y, p.z - lower.z, upper.x - p.x,
                              upper.y - p.y, upper.z - p.z});
}

bool isFiniteBody(const Spheres& spheres, std::size_t k) {
    return isFinite(spheres.positions[k]) && isFinite(spheres.velocities[k]);
}

void addEnergies(Metrics& m, const Spheres& spheres, std::size_t k, Bounds bounds, Vec3d gravity,
                 double dt) {
    const Vec3d position = widen(spheres.positions[k]), velocity = widen(spheres.velocities[k]);
    const double mass = spheres.masses[k];
    const double kinetic = 0.5 * mass * dot(velocity, velocity);
    const double potential = -mass * dot(gravity, minus(position, widen(bounds.lower)));
    m.kineticEnergy += kinetic;
    m.potentialEnergy += potential;
    m.shadowEnergy += kinetic + potential + 0.5 * mass * dt * dot(gravity, velocity);
}

void addBody(Metrics& m, const Spheres& spheres, std::size_t k, Bounds bounds, Vec3d gravity,
             double dt, bool walled) {
    addEnergies(m, spheres, k, bounds, gravity, dt);
    const Vec3d position = widen(spheres.positions[k]), velocity = widen(spheres.velocities[k]);
    const double mass = spheres.masses[k];
    addScaled(m.momentum, mass, velocity);
    addScaled(m.angularMomentum, mass, cross(position, velocity));
    if (!contains(bounds, spheres.positions[k])) ++m.lost;
    if (walled)
        m.largestPenetration =
            std::max(m.largestPenetration, wallPenetration(position, spheres.radii[k], bounds));
}

}  // namespace

double length(Vec3d v) { return std::sqrt(dot(v, v)); }

double penetrationOf(const Spheres& spheres, Pair pair, const std::optional<Bounds>& periodic) {
    Vec3d offset =
        minus(widen(spheres.positions[pair.second]), widen(spheres.positions[pair.first]));
    if (periodic) {
        const Vec3d period = minus(widen(periodic->upper), widen(periodic->lower));
        offset = {toNearestImage(offset.x, period.x), toNearestImage(offset.y, period.y),
                  toNearestImage(offset.z, period.z)};
    }
    const double reach = double(spheres.radii[pair.first]) + spheres.radii[pair.second];
    return std::max(0.0, reach - length(offset));
}

Metrics measure(const Spheres& spheres, Bounds bounds, Vec3 gravity, float dt, bool periodic) {
    const std::optional<Bounds> box = periodic ? std::optional(bounds) : std::nullopt;
    Metrics m;
    for (std::size_t k = 0; k < spheres.count(); ++k) {
        if (isFiniteBody(spheres, k))
            addBody(m, spheres, k, bounds, widen(gravity), dt, !periodic);
        else
            ++m.notFinite;
    }
    const std::vector<Pair> pairs = findPairsOnHost(spheres, box);
    double sum = 0.0;
    for (const Pair pair : pairs) {
        const double penetration = penetrationOf(spheres, pair, box);
        sum += penetration;
        m.largestPenetration = std::max(m.largestPenetration, penetration);
    }
    m.contacts = pairs.size();
    m.meanPenetration = pairs.empty() ? 0.0 : sum / static_cast<double>(pairs.size());
    return m;
}

double shadowEnergyOf(const Spheres& spheres, Bounds bounds, Vec3 gravity, float dt) {
    Metrics m;
    for (std::size_t k = 0; k < spheres.count(); ++k)
        if (isFiniteBody(spheres, k)) addEnergies(m, spheres, k, bounds, widen(gravity), dt);
    return m.shadowEnergy;
}

namespace {

/// Mixes words one after the other: Fibonacci hashing's multiplier, folded after each.
struct Mixer {
    std::uint64_t hash = 0xCBF29CE484222325u;
    void add(std::uint32_t word) {
        hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
    }
};

}  // namespace

std::uint64_t stateHash(const Spheres& spheres) {
    Mixer mixer;
    for (std::size_t k = 0; k < spheres.count(); ++k) {
        for (const Vec3 v : {spheres.positions[k], spheres.velocities[k]})
            for (const float value : {v.x, v.y, v.z})
                mixer.add(std::bit_cast<std::uint32_t>(value));
    }
    return mixer.hash;
}

std::uint64_t wordHash(std::span<const std::uint32_t> words) {
    Mixer mixer;
    for (const std::uint32_t word : words) mixer.add(word);
    return mixer.hash;
}

std::string hashText(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

}  // namespace ballpit
