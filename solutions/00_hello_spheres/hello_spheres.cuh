// Chapter 00: a first kernel, finished. It sets balls on a hill in spirals, as in a sunflower.
#pragma once

#include "common/buffer.cuh"
#include "common/vec3.cuh"

namespace ballpit {

/// What the kernel must know: lengths in m, turns in steps (below).
struct Hill {
    float radius, height, ballRadius;
    std::uint32_t count, firstTurn;
};

// A whole turn has 2^32 steps: who turns on and on comes round by overflow, exactly.
constexpr std::uint32_t quarterTurn = 1u << 30, thirdOfATurn = 1431655765u;
constexpr std::uint32_t goldenTurn = 2654435769u;  // 0.618 of a turn: 2^32 / golden ratio

//@show sine
/// Sine of an angle in steps, to five digits. sinf would give other bits on other machines; + - *
/// give the same ones everywhere.
HD inline float sineOf(std::uint32_t turn) {
    const float t = static_cast<float>(static_cast<std::int32_t>(turn)) * 0x1p-32f;
    const float x = t > 0.25f ? 0.5f - t : t < -0.25f ? -0.5f - t : t;  // -1/4 to 1/4 turn
    const float q = x * x;
    return x *
           (6.2831853f + q * (-41.341702f + q * (81.60525f + q * (-76.70586f + q * 42.058694f))));
}
//@end

HD inline float cosineOf(std::uint32_t turn) { return sineOf(turn + quarterTurn); }

/// A bright colour at this place of the colour wheel: red, green and blue rise and fall in turn.
HD inline Vec3 colorOf(std::uint32_t turn) {
    return {0.60f + 0.38f * cosineOf(turn), 0.55f + 0.35f * cosineOf(turn - thirdOfATurn),
            0.58f + 0.38f * cosineOf(turn + thirdOfATurn)};
}

//@show kernel
/// Places and colours ball i: a golden turn further round than ball i - 1, and a little lower.
HD inline void placeBall(int i, Hill hill, View<Vec4> positions, View<Vec3> colors) {
    const auto k = static_cast<std::uint32_t>(i);
    const std::uint32_t turn = hill.firstTurn + k * goldenTurn;
    // The share of the hill that lies above this ball: near 0 at the top, near 1 at the rim.
    const float share = static_cast<float>(2 * k + 1) / static_cast<float>(2 * hill.count);
    const float aside = hill.radius * sqrtf(share);
    const float ballRadius = hill.ballRadius * (1.0f + 0.25f * share);
    positions[i] = {aside * cosineOf(turn), ballRadius + hill.height * (1.0f - share),
                    aside * sineOf(turn), ballRadius};
    colors[i] = colorOf(2 * turn + k * (0xFFFFFFFFu / hill.count));
}
//@end

/// A hill on which no two balls touch, however many there are; `seed` turns it.
inline Hill makeHill(int count, std::uint64_t seed) {
    constexpr float radius = 4.0f, height = 1.7f;
    constexpr std::uint32_t sixteenthOfATurn = quarterTurn / 4;
    const float ballRadius = radius * minimum(0.15f, 0.75f / sqrtf(static_cast<float>(count)));
    return {radius, height, ballRadius, static_cast<std::uint32_t>(count),
            static_cast<std::uint32_t>(seed) * sixteenthOfATurn};
}

}  // namespace ballpit
