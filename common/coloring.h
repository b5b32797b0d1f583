// What the colour of a ball tells: who it is, how fast, how many it touches, its cell, its place in
// memory. All palettes can be told apart by colour-blind eyes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/pair_list.cuh"
#include "common/spheres.h"

namespace ballpit {

enum class ColorBy { body, speed, contacts, cell, memory };

/// All of them, in the order in which a viewer goes through them.
inline constexpr std::array allColorings{ColorBy::body, ColorBy::speed, ColorBy::contacts,
                                         ColorBy::cell, ColorBy::memory};

const char* name(ColorBy by);

/// By name. InputError for another name.
ColorBy coloringNamed(const std::string& name);

/// The one behind `by` in allColorings; behind the last comes the first.
ColorBy nextColoring(ColorBy by);

/// What a step left behind. Only what the colouring looks at must be there: `pairs` for contacts,
/// `memoryOrder` for memory, the world for cell, `topSpeed` for speed.
struct ColoringSource {
    const Spheres& balls;
    std::span<const Pair> pairs;                 ///< touching, by body number
    std::span<const std::uint32_t> memoryOrder;  ///< the body in each slot
    Vec3 gridOrigin;                             ///< m
    float cellSize = 1.0f;                       ///< m
    float topSpeed = 1.0f;                       ///< m/s: this and all above is the ramp's end
};

/// One colour a ball, by body number.
std::vector<Vec3> colorsBy(ColorBy by, const ColoringSource& source);

// The palettes. Shares run from 0 to 1 and are clamped.

/// Dark violet, blue, green, yellow: evenly brighter, so that faster looks faster (viridis).
Vec3 speedColor(float share);

/// Grey for none, then from pale yellow to dark red at six and more.
Vec3 contactColor(std::size_t contacts);

/// One of eight colours; cells that share a face, an edge or a corner never have the same.
Vec3 cellColor(Int3 cell);

/// Blue for the first in a row, orange for the last.
Vec3 rampColor(float share);

}  // namespace ballpit
