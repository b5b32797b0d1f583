// Chapter 07: the lesson's scenes of a few balls, with their contacts named by hand.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "common/metrics.h"
#include "common/one_round.cuh"

namespace ballpit {

/// Balls of radius 0.5 m, and which of them touch.
struct Example {
    Spheres balls;
    std::vector<Pair> pairs;
};

/// The lesson's worked example: 1 kg at 3 m/s meets 2 kg at rest, off centre, overlapping by 5 cm.
inline Example twoBalls() {
    Example example{{}, {{0, 1}}};
    example.balls.add({0, 0, 0}, {3, 0, 0}, 0.5f, 1.0f, 0.5f);
    example.balls.add({0.76f, 0.57f, 0}, {0, 0, 0}, 0.5f, 2.0f, 0.5f);
    return example;
}

/// Elastic balls of 1 kg that just touch in a row along x, with these velocities along x.
inline Example rowOf(const std::vector<float>& speeds) {
    Example example;
    for (std::uint32_t k = 0; k < speeds.size(); ++k) {
        example.balls.add({static_cast<float>(k), 0, 0}, {speeds[k], 0, 0}, 0.5f, 1.0f, 1.0f);
        if (k > 0) example.pairs.push_back({k - 1, k});
    }
    return example;
}

/// Three elastic balls of 1 kg that touch each other, at rest, and a fourth that comes straight
/// down on all three with 1 m/s: a tetrahedron of edge 1 m.
inline Example pocketOfThree() {
    Example example{{}, {{0, 3}, {1, 3}, {2, 3}}};
    for (const Vec3 place : {Vec3{-0.5f, 0, -0.28867513f}, Vec3{0.5f, 0, -0.28867513f},
                             Vec3{0, 0, 0.57735027f}, Vec3{0, 0.81649658f, 0}})
        example.balls.add(place, {0, place.y > 0 ? -1.0f : 0.0f, 0}, 0.5f, 1.0f, 1.0f);
    return example;
}

/// The balls after one round of `response`, with the threads in `order` on a CPU.
inline Spheres resolved(Device device, const Example& example, Response& response,
                        LaunchOrder order = LaunchOrder::forward) {
    launchOrder() = order;
    const Spheres balls = OneRound(device, example.balls, example.pairs).resolve(response);
    launchOrder() = LaunchOrder::forward;
    return balls;
}

/// The velocities along x, as text: "0 -2 1".
inline std::string speedsAlongX(const Spheres& balls) {
    std::string text;
    for (const Vec3 v : balls.velocities) {
        char number[16];
        std::snprintf(number, sizeof number, text.empty() ? "%.3g" : " %.3g", double(v.x));
        text += number;
    }
    return text;
}

/// J.
inline double kineticEnergy(const Spheres& balls) {
    return measure(balls, {}, {}, 0).kineticEnergy;
}

/// kg m/s: how far the momenta of two states are apart. Impulses between balls leave it 0.
inline double momentumBetween(const Spheres& before, const Spheres& after) {
    const Vec3d p = measure(before, {}, {}, 0).momentum, q = measure(after, {}, {}, 0).momentum;
    return length(Vec3d{q.x - p.x, q.y - p.y, q.z - p.z});
}

}  // namespace ballpit
