// Chapter 00's balls as the checks see them, and the oracle: it computes the hill with the
// library's sine in double precision.
#pragma once

#include "00_hello_spheres/hello_spheres.cuh"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "common/spheres.h"
#include "tests/checks/canvas.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

constexpr Bounds world{{-4.8f, 0, -4.8f}, {4.8f, 3, 4.8f}};

/// What placeBall writes: x, y, z, radius of each ball, and its colour.
struct Placed {
    std::vector<Vec4> balls;
    std::vector<Vec3> colors;

    /// The bits, so that comparing is exact and NaN equals NaN.
    std::vector<std::uint32_t> words() const {
        std::vector<std::uint32_t> all;
        for (std::size_t k = 0; k < balls.size(); ++k)
            for (const float value : {balls[k].x, balls[k].y, balls[k].z, balls[k].w, colors[k].x,
                                      colors[k].y, colors[k].z})
                all.push_back(std::bit_cast<std::uint32_t>(value));
        return all;
    }
    bool operator==(const Placed& other) const { return words() == other.words(); }
};

inline Placed placeAll(Device device, int count, std::uint64_t seed = 0) {
    DeviceBuffer<Vec4> positions(device, static_cast<std::size_t>(count), "positions");
    DeviceBuffer<Vec3> colors(device, static_cast<std::size_t>(count), "colors");
    launch<placeBall>(device, count, makeHill(count, seed), positions.view(), colors.view());
    return {positions.download(), colors.download()};
}

inline Spheres spheresOf(const Placed& placed) {
    Spheres spheres;
    for (std::size_t k = 0; k < placed.balls.size(); ++k)
        spheres.add(xyz(placed.balls[k]), {}, placed.balls[k].w, 1.0f, 1.0f, placed.colors[k]);
    return spheres;
}

// ---- the oracle, and the classic mistakes it can make on purpose

struct Formula {
    // Turns from one ball to the next, rounded to a whole number of steps.
    double golden = std::round(0x1p31 * (std::sqrt(5.0) - 1.0)) / 0x1p32;
    bool wholeShares = false, sineTwice = false, zUp = false;
    double radiusFactor = 1.0;
};

constexpr double wholeTurn = 2.0 * std::numbers::pi;

inline std::vector<Vec4> oracle(int count, std::uint64_t seed, const Formula& formula = {}) {
    std::vector<Vec4> balls;
    const Hill hill = makeHill(count, 0);
    for (int k = 0; k < count; ++k) {
        double share = (k + 0.5) / count;
        if (formula.wholeShares) share = std::floor(share);
        const double angle = wholeTurn * (k * formula.golden + static_cast<double>(seed) / 16.0);
        const double aside = hill.radius * std::sqrt(share);
        const double radius = formula.radiusFactor * hill.ballRadius * (1.0 + 0.25 * share);
        const auto x = float(aside * (formula.sineTwice ? std::sin(angle) : std::cos(angle)));
        const auto z = float(aside * std::sin(angle));
        const auto y = float(radius + hill.height * (1.0 - share));
        balls.push_back({x, formula.zUp ? z : y, formula.zUp ? y : z, float(radius)});
    }
    return balls;
}

inline bool isNear(float got, float expected) { return std::abs(got - expected) <= 1e-4f; }

inline bool isNear(Vec4 got, Vec4 expected) {
    return isNear(got.x, expected.x) && isNear(got.y, expected.y) && isNear(got.z, expected.z) &&
           isNear(got.w, expected.w);
}

inline bool allNear(const std::vector<Vec4>& got, const std::vector<Vec4>& expected) {
    return std::equal(got.begin(), got.end(), expected.begin(), expected.end(),
                      [](Vec4 a, Vec4 b) { return isNear(a, b); });
}

inline std::string text(Vec4 ball) { return text(xyz(ball)) + " of radius " + text(ball.w); }

inline void guessMistake(Report& report, const std::vector<Vec4>& got, std::uint64_t seed) {
    if (got.size() < 8) return;  // one or two balls fit too many explanations
    const auto equals = [&](const Formula& formula) {
        return [&, formula] { return allNear(got, oracle(int(got.size()), seed, formula)); };
    };
    Formula halfTurn, wholeShares, sineTwice, zUp, diameter;
    halfTurn.golden = 0.5;
    wholeShares.wholeShares = true;
    sineTwice.sineTwice = true;
    zUp.zUp = true;
    diameter.radiusFactor = 2.0;
    report.guess(
        {{"a division of integers: it throws the fraction away, so every share is 0",
          equals(wholeShares)},
         {"half a turn in place of the golden turn: all balls lie on one line", equals(halfTurn)},
         {"the sine along x and along z: one of them must be the cosine", equals(sineTwice)},
         {"y and z exchanged: y points up", equals(zUp)},
         {"the diameter in place of the radius: every ball is twice too large", equals(diameter)}});
}

/// Seen from above, x to the right, z down: yours, reference, and what differs in red.
inline Frame drawHill(const Placed& placed, const std::vector<Vec4>& expected) {
    return threePanels(
        world.lower.x, world.lower.z, extent(world).x, 300,
        [&](Canvas& canvas, const Panel& panel, int k) {
            for (std::size_t i = expected.size(); i-- > 0;) {
                const Vec4 ball = k == 0 ? placed.balls[i] : expected[i];
                const bool wrong = !isNear(placed.balls[i], expected[i]);
                const Vec3 color = k < 2 ? placed.colors[i] : wrong ? colors::red : colors::grey;
                canvas.disc(panel.x(ball.x), panel.y(-ball.z), panel.scale * ball.w, color);
            }
        });
}

}  // namespace ballpit::check
