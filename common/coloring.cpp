// The palettes, and which value of a ball chooses from them.
#include "common/coloring.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/words.h"

namespace ballpit {

namespace {

constexpr std::array coloringNames{"body", "speed", "contacts", "cell", "memory"};
static_assert(coloringNames.size() == allColorings.size());

std::vector<Vec3> bySpeed(const ColoringSource& source) {
    std::vector<Vec3> colors;
    for (const Vec3 velocity : source.balls.velocities)
        colors.push_back(speedColor(length(velocity) / source.topSpeed));
    return colors;
}

std::vector<Vec3> byContacts(const ColoringSource& source) {
    std::vector<std::size_t> contacts(source.balls.count(), 0);
    for (const auto [first, second] : source.pairs) ++contacts.at(first), ++contacts.at(second);
    std::vector<Vec3> colors;
    for (const std::size_t count : contacts) colors.push_back(contactColor(count));
    return colors;
}

std::vector<Vec3> byCell(const ColoringSource& source) {
    const auto along = [&](float coordinate, float origin) {
        return static_cast<int>(std::floor((coordinate - origin) / source.cellSize));
    };
    std::vector<Vec3> colors;
    for (const Vec3 p : source.balls.positions)
        colors.push_back(
            cellColor({along(p.x, source.gridOrigin.x), along(p.y, source.gridOrigin.y),
                       along(p.z, source.gridOrigin.z)}));
    return colors;
}

std::vector<Vec3> byMemory(const ColoringSource& source) {
    std::vector<Vec3> colors(source.balls.count());
    const auto slots = static_cast<float>(source.memoryOrder.size());
    for (std::size_t slot = 0; slot < source.memoryOrder.size(); ++slot)
        colors.at(source.memoryOrder[slot]) = rampColor(static_cast<float>(slot) / slots);
    return colors;
}

}  // namespace

const char* name(ColorBy by) { return coloringNames.at(static_cast<std::size_t>(by)); }

ColorBy coloringNamed(const std::string& wanted) {
    for (const ColorBy by : allColorings)
        if (wanted == name(by)) return by;
    throw InputError("colour by '" + wanted + "': known are " +
                     commaSeparated(allColorings, [](ColorBy by) { return name(by); }));
}

ColorBy nextColoring(ColorBy by) {
    return allColorings.at((static_cast<std::size_t>(by) + 1) % allColorings.size());
}

std::vector<Vec3> colorsBy(ColorBy by, const ColoringSource& source) {
    switch (by) {
        case ColorBy::speed:
            return bySpeed(source);
        case ColorBy::contacts:
            return byContacts(source);
        case ColorBy::cell:
            return byCell(source);
        case ColorBy::memory:
            return byMemory(source);
        case ColorBy::body:
            break;
    }
    return source.balls.colors;
}

/// Nine samples of matplotlib's viridis (CC0), joined by straight lines.
Vec3 speedColor(float share) {
    static constexpr std::array<Vec3, 9> samples{{{0.267f, 0.005f, 0.329f},
                                                  {0.279f, 0.175f, 0.483f},
                                                  {0.230f, 0.322f, 0.546f},
                                                  {0.173f, 0.449f, 0.558f},
                                                  {0.128f, 0.567f, 0.551f},
                                                  {0.158f, 0.684f, 0.502f},
                                                  {0.369f, 0.789f, 0.383f},
                                                  {0.678f, 0.864f, 0.190f},
                                                  {0.993f, 0.906f, 0.144f}}};
    // A NaN fails both comparisons and ends as 0.
    const float place = 8.0f * (share > 0.0f ? std::min(share, 1.0f) : 0.0f);
    const std::size_t below = std::min<std::size_t>(7, static_cast<std::size_t>(place));
    const float rest = place - static_cast<float>(below);
    return samples[below] + rest * (samples[below + 1] - samples[below]);
}

/// Grey, then ColorBrewer's YlOrRd.
Vec3 contactColor(std::size_t contacts) {
    static constexpr std::array<Vec3, 7> samples{{{0.66f, 0.68f, 0.72f},
                                                  {0.996f, 0.851f, 0.463f},
                                                  {0.996f, 0.698f, 0.298f},
                                                  {0.992f, 0.553f, 0.235f},
                                                  {0.988f, 0.306f, 0.165f},
                                                  {0.890f, 0.102f, 0.110f},
                                                  {0.694f, 0.000f, 0.149f}}};
    return samples[std::min(contacts, samples.size() - 1)];
}

/// Okabe and Ito's palette, with white for its black. Neighbouring cells differ by one along some
/// axis, so they differ in whether that coordinate is even: eight kinds of cells.
Vec3 cellColor(Int3 cell) {
    static constexpr std::array<Vec3, 8> samples{{{0.90f, 0.62f, 0.00f},
                                                  {0.00f, 0.45f, 0.70f},
                                                  {0.00f, 0.62f, 0.45f},
                                                  {0.94f, 0.89f, 0.26f},
                                                  {0.84f, 0.37f, 0.00f},
                                                  {0.34f, 0.71f, 0.91f},
                                                  {0.97f, 0.97f, 0.97f},
                                                  {0.80f, 0.47f, 0.65f}}};
    return samples[static_cast<std::size_t>((cell.x & 1) + 2 * (cell.y & 1) + 4 * (cell.z & 1))];
}

Vec3 rampColor(float share) {
    const float s = share > 0.0f ? std::min(share, 1.0f) : 0.0f;
    return {0.1f + 0.85f * s, 0.45f, 0.9f - 0.8f * s};
}

}  // namespace ballpit
