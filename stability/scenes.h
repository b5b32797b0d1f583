// The scenes in which responses are put to the test, one family a file. Each is a plain function of
// its knobs; the same knobs and seed give the same bits everywhere. Unless said otherwise: balls of
// radius 0.5 m and 1 kg, no damping. catalogue.h says what each asks, and how exactly.
#pragma once

#include <cstdint>

#include "common/scene.h"

namespace ballpit::stability {

constexpr float ballRadius = 0.5f;       ///< m
constexpr float gravityOfEarth = 9.81f;  ///< m/s^2

/// Two balls without gravity: the first, of 1 kg, comes along x and misses the centre of the
/// second, at rest, by `offset` diameters (0 head-on, below 1).
struct TwoBodies {
    float massRatio = 1.0f;  ///< the second's mass over the first's
    float offset = 0.0f;     ///< b / sigma
    float travel = 0.1f;     ///< v dt / r: radii in a step
    float phase = 0.0f;      ///< 0 to 1: the share of a step by which the contact comes earlier
    float restitution = 1.0f;
};
Scene makeTwoBodies(const TwoBodies& knobs);

/// `pairs` such meetings (equal masses, elastic, 0.1 radii a step) in lanes of their own: offsets
/// as often as a random aim has them, phases at random. Bodies 2k and 2k + 1 meet.
Scene makeMeetings(int pairs, std::uint64_t seed);

/// SimBenchmark's bouncing balls: 7 x 7 balls of 0.1 m and 10 kg fall 5 m, none above another.
Scene makeBounce(float restitution);

/// Newton's cradle of `count` elastic balls along x, the first coming with 1 m/s. `reversed`: body
/// 0 is the last in line, so that whatever follows the numbers meets the contacts in the other
/// order.
Scene makeCradle(int count, bool reversed);

/// A ball comes straight down on three that touch each other and rest, with no gravity: a
/// tetrahedron, all contacts in the same step.
Scene makePocket(float restitution);

/// A hub meets `spokes` small balls at rest at once, evenly around its way.
struct Hub {
    int spokes = 3;          ///< 1 to 12
    float massRatio = 1.0f;  ///< a spoke's mass over the hub's
    float cosine = 0.7f;     ///< of the angle between the hub's way and each spoke, below 0.75
    float restitution = 1.0f;
};
Scene makeHub(const Hub& knobs);

/// A gas between walls, or in a periodic box; on a lattice at first. Random velocities with no sum
/// and with the root mean square `speed`.
struct Gas {
    int count = 343;
    float volumeShare = 0.3f;  ///< of the box that is ball, below 0.5
    float travel = 0.1f;       ///< rms speed times dt / r
    float restitution = 1.0f;
    std::uint64_t seed = 1;
    bool periodic = false;
};
constexpr float gasSpeed = 1.7320508f;  ///< m/s, rms: a temperature of 1 J
Scene makeGasOf(const Gas& knobs);

/// SimBenchmark's 666: 6 x 6 x 6 balls of 0.1 m and 10 kg, 0.21 m apart, each shifted by up to
/// 1 mm, fall into a heap. Our floor has walls, 1.26 m wide, as all our worlds.
Scene makeSixCubed(float restitution, std::uint64_t seed);

/// `count` dull balls on top of each other, touching.
Scene makeColumn(int count, float restitution);

/// One ball on another: the upper has `ratio` times the mass.
Scene makeHeavyOnLight(float ratio, float restitution);

/// Equal dull balls on a jittered lattice above a floor, ten times as high as wide at most: what
/// they settle to is deep.
Scene makeDeepPile(int count, std::uint64_t seed);

/// A settling heap of radii between r / sqrt(q) and r sqrt(q), of equal density.
Scene makeMixedRadii(int count, float ratio, std::uint64_t seed);

/// One ball of 2 kg shot with `travel` radii a step at a lattice of balls at rest, `side` along
/// each edge.
Scene makeBullet(int side, float travel);

/// `bullets` such shots at lattices of 3 x 3 x 3 balls, in lanes of their own, at random phases of
/// the step and up to 0.3 radii off their line. A bullet comes before its lattice in the order.
Scene makeVolley(int bullets, float travel, std::uint64_t seed);

// Pathologies: what no scene should ask for, and every engine is asked for some day.

/// Balls at random places within one cell of the grid.
Scene makeOneCell(int count, std::uint64_t seed);
/// Pairs of balls with the very same centre.
Scene makeCoincident(int count);
/// Two balls so fast that their impulse is not a number that a float can hold.
Scene makeNotFinite();
/// Balls that start outside the walls, on all sides.
Scene makeOutside(int count, std::uint64_t seed);
/// A column of `count` balls `distance` m away from the origin.
Scene makeFarFromOrigin(int count, float distance);

}  // namespace ballpit::stability
