// What chapter 07's checks compare with: scenes, and an oracle in double precision that knows no
// impulse. It takes each contact to the frame of the pair's centre of mass, in which every ball
// comes back with e times its speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "07_impulse_response/atomic_response.cuh"
#include "07_impulse_response/examples.cuh"
#include "07_impulse_response/impulse_response.cuh"
#include "common/host_pairs.h"
#include "common/random.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

// ---- running a version

enum class Version { inPlace, atomic, gathered };

inline const char* name(Version version) {
    if (version == Version::inPlace) return "in place";
    return version == Version::atomic ? "atomic" : "gathered";
}

inline std::unique_ptr<Response> make(Version version, Device device, const Example& example) {
    if (version == Version::inPlace) return std::make_unique<RacyResponse>(device);
    if (version == Version::atomic) return std::make_unique<AtomicResponse>(device);
    return std::make_unique<ImpulseResponse>(device, example.balls.count(), example.pairs.size());
}

inline Spheres resolvedBy(Version version, Device device, const Example& example) {
    const auto response = make(version, device, example);
    return OneRound(device, example.balls, example.pairs).resolve(*response);
}

// ---- scenes

/// Balls of all kinds that overlap at random, about two contacts each. A restitution below 0: each
/// ball has its own.
inline Example randomScene(int count, std::uint64_t seed, float restitution = -1) {
    const float side = 0.5f * std::cbrt(static_cast<float>(count)) * 1.3f;
    Random random(seed);
    Example example;
    for (int k = 0; k < count; ++k) {
        const Vec3 place = random.uniformIn({{-side, -side, -side}, {side, side, side}});
        const Vec3 velocity = random.uniformIn({{-3, -3, -3}, {3, 3, 3}});
        const float radius = random.uniform(0.3f, 0.6f), mass = random.uniform(0.5f, 4.0f);
        const float own = random.uniform(0.0f, 1.0f);
        example.balls.add(place, velocity, radius, mass, restitution < 0 ? own : restitution);
    }
    example.pairs = findPairsOnHost(example.balls);
    return example;
}

/// A layer for pictures: seven pairs of a light ball and a heavy one, and three balls that all
/// meet.
inline Example flatScene(std::uint64_t seed) {
    Random random(seed);
    Example example;
    const auto add = [&](Vec3 place, Vec3 velocity, float mass, float restitution) {
        example.balls.add(place, velocity, 0.42f, mass, restitution);
    };
    const Bounds upToOne{{-1, -1, 0}, {1, 1, 0}};
    for (int k = 0; k < 7; ++k) {
        const Vec3 place{1.7f * static_cast<float>(k % 3 - 1), 1.9f * static_cast<float>(k / 3 - 1),
                         0};
        const float angle = random.uniform(0, 6.28f);
        const Vec3 aside{0.4f * std::cos(angle), 0.4f * std::sin(angle), 0};
        add(place - aside, random.uniformIn(upToOne), 1, 1.0f);
        add(place + aside, random.uniformIn(upToOne), 3, 0.4f);
    }
    for (const Vec3 place : {Vec3{0.6f, 1.9f, 0}, Vec3{1.3f, 1.6f, 0}, Vec3{1.25f, 2.35f, 0}})
        add(place, 0.8f * (Vec3{1.05f, 1.95f, 0} - place), 1, 1);
    example.pairs = findPairsOnHost(example.balls);
    return example;
}

// ---- the oracle

/// How contacts are resolved. All but `split` are mistakes.
struct Rules {
    bool split;        ///< a ball with n contacts enters each of them with 1/n of its mass
    double share = 1;  ///< of the impulse that arrives
    bool pulls = false, massOfFirst = false, bouncier = false;
};

inline Vec3d operator+(Vec3d a, Vec3d b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3d operator*(double s, Vec3d a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3d wide(Vec3 v) { return {v.x, v.y, v.z}; }
inline Vec3 narrow(Vec3d v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A pair along its line of centres.
struct Line {
    Vec3d normal;
    double distance, speedA, speedB;
    bool approaches() const { return speedA > speedB; }
};

inline Line lineOf(Pair pair, const Spheres& balls) {
    const Vec3d a = wide(balls.positions[pair.first]), b = wide(balls.positions[pair.second]);
    const Vec3d between = b + -1.0 * a;
    const Vec3d normal = 1 / length(between) * between;
    return {normal, length(between), dot(wide(balls.velocities[pair.first]), normal),
            dot(wide(balls.velocities[pair.second]), normal)};
}

/// Two masses, of which each ball may enter the contact with a part.
struct Parts {
    double a, b;
};

inline Parts partsOf(Pair pair, const Spheres& balls, const std::vector<double>& contacts,
                     bool split) {
    const auto part = [&](std::uint32_t k) {
        return balls.masses[k] / (split ? std::max(contacts[k], 1.0) : 1.0);
    };
    return {part(pair.first), part(pair.second)};
}

/// N s that pass from the first ball to the second.
inline double passedOn(const Line& line, Parts parts, double restitution) {
    const double common = (parts.a * line.speedA + parts.b * line.speedB) / (parts.a + parts.b);
    return parts.a * (1 + restitution) * (line.speedA - common);
}

inline Spheres oracle(const Example& example, const Rules& rules) {
    const Spheres& balls = example.balls;
    std::vector<double> touching(balls.count(), 0), approaching(balls.count(), 0);
    for (const Pair pair : example.pairs)
        for (const std::uint32_t k : {pair.first, pair.second}) {
            touching[k] += 1;
            if (lineOf(pair, balls).approaches()) approaching[k] += 1;
        }
    std::vector<Vec3d> velocities, positions;
    for (const Vec3 v : balls.velocities) velocities.push_back(wide(v));
    for (const Vec3 p : balls.positions) positions.push_back(wide(p));
    for (const Pair pair : example.pairs) {
        const auto [a, b] = pair;
        const Line line = lineOf(pair, balls);
        const double massA = balls.masses[a], massB = balls.masses[b];
        if (line.approaches() || rules.pulls) {
            const auto [low, high] = std::minmax(balls.restitutions[a], balls.restitutions[b]);
            const double passed =
                rules.share * passedOn(line, partsOf(pair, balls, approaching, rules.split),
                                       rules.bouncier ? high : low);
            velocities[a] = velocities[a] + -passed / massA * line.normal;
            velocities[b] =
                velocities[b] + passed / (rules.massOfFirst ? massA : massB) * line.normal;
        }
        // Each part gives way by the other's share of the overlap; the whole ball by less.
        const Parts parts = partsOf(pair, balls, touching, rules.split);
        const double pushed = (balls.radii[a] + balls.radii[b] - line.distance) * parts.a *
                              parts.b / (parts.a + parts.b);
        positions[a] = positions[a] + -pushed / massA * line.normal;
        positions[b] = positions[b] + pushed / massB * line.normal;
    }
    Spheres result = balls;
    std::transform(velocities.begin(), velocities.end(), result.velocities.begin(), narrow);
    std::transform(positions.begin(), positions.end(), result.positions.begin(), narrow);
    return result;
}

/// kg m/s that rounding may cost: a millionth of what the balls could carry together.
inline double momentumTolerance(const Spheres& before, const Spheres& after) {
    double mass = 0;
    for (const float m : before.masses) mass += m;
    const double energy = std::max(kineticEnergy(before), kineticEnergy(after));
    return 1e-6 * std::sqrt(2 * mass * energy) + 1e-12;
}

// ---- comparing

/// Fails unless `got` lies within `tolerance` of `expected`; NaN never does.
inline void requireNear(Report& report, const std::string& what, Vec3 got, Vec3 expected,
                        float tolerance = 1e-5f) {
    if (!(length(got - expected) <= tolerance)) report.fail(what, text(got), text(expected));
}
inline void requireNear(Report& report, const std::string& what, double got, double expected,
                        double tolerance = 1e-5) {
    if (!(std::abs(got - expected) <= tolerance))
        report.fail(what, text(static_cast<float>(got)), text(static_cast<float>(expected)));
}

/// Velocities and positions of all balls.
inline void requireSameBalls(Report& report, const std::string& where, const Spheres& got,
                             const Spheres& expected, float tolerance = 1e-5f) {
    for (std::size_t k = 0; k < got.count(); ++k) {
        requireNear(report, where + ": velocity of ball " + text(k), got.velocities[k],
                    expected.velocities[k], tolerance);
        requireNear(report, where + ": position of ball " + text(k), got.positions[k],
                    expected.positions[k], tolerance);
    }
}

inline bool haveVelocities(const Spheres& got, const Spheres& expected) {
    for (std::size_t k = 0; k < got.count(); ++k)
        if (!(length(got.velocities[k] - expected.velocities[k]) <= 1e-4f)) return false;
    return true;
}

}  // namespace ballpit::check
