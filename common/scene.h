// Scenes: bodies and the world they start in. The same seed gives the same bits everywhere.
#pragma once

#include <cstdint>
#include <string>

#include "common/spheres.h"

namespace ballpit {

struct Scene {
    std::string name;
    Spheres spheres;
    Bounds bounds;          ///< m
    float cellSize;         ///< m
    Vec3 gravity;           ///< m/s^2
    float damping;          ///< 1/s
    float dt;               ///< s
    bool periodic = false;  ///< no walls: what leaves on one side comes in on the other
};

/// The original design's example: balls of mixed radii (0.3 to 0.9 m), masses (equal density) and
/// restitutions (0.3 to 0.9), none overlapping, above the floor of a 40 m world. Beyond 8000 balls
/// all lengths of the balls shrink so that they fit.
Scene makeGravityFall(int count, std::uint64_t seed);

/// Equal balls (r 0.5 m, 1 kg, elastic) at random places, overlaps and all: half a touching pair a
/// ball, one contact a ball. No gravity.
Scene makeUniform(int count, std::uint64_t seed);

/// Equal elastic balls (r 0.5 m, 1 kg) that fill 48 % of their cube and move up to a twentieth of
/// their radius a step: a dense gas, one to two contacts a ball. No gravity.
Scene makeGas(int count, std::uint64_t seed);

/// Equal balls (r 0.5 m, 1 kg, e 0.3) stacked in a cube with hardly any room: about three touching
/// pairs a ball from the first step on.
Scene makePile(int count, std::uint64_t seed);

// Scenes that show one thing each: equal balls (r 0.5 m, 1 kg), all lengths fixed.

/// Without gravity. In each lane a ball of 3 m/s meets one at rest; restitution 0 in the first
/// lane, 1 in the last. Two balls a lane.
Scene makeHeadOn(int count, std::uint64_t seed);

/// Without gravity: balls at rest at random places deep inside each other.
Scene makeStaticOverlap(int count, std::uint64_t seed);

/// Balls in a row, dropped from 6 m; restitution 0 for the first, 1 for the last.
Scene makeFallingBalls(int count, std::uint64_t seed);

/// Without gravity, on a table: an elastic ball of 6 m/s comes to a triangle of balls at rest that
/// touch.
Scene makeBreak(int count, std::uint64_t seed);

/// Makes a scene of this many balls.
using SceneMaker = Scene (*)(int count, std::uint64_t seed);

struct SceneKind {
    const char* name;
    int usualCount;  ///< of balls
    SceneMaker make;
    int leastCount = 1, mostCount = 2147483647;
};

/// The scene of that name; InputError, naming all, if there is none.
SceneKind sceneKind(const std::string& name);

/// All names, as "a, b, c".
std::string sceneNames();

/// By name. InputError for an unknown name or a count that the scene cannot have.
Scene makeScene(const std::string& name, int count, std::uint64_t seed);

/// Random places for balls of these radii inside `box` so that none overlap or touch a wall.
/// InputError if they do not fit (random placing fills about a quarter of a box).
std::vector<Vec3> nonOverlappingPositions(const std::vector<float>& radii, Bounds box,
                                          std::uint64_t seed);

}  // namespace ballpit
