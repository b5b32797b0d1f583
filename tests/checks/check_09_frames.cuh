// Chapter 09: frames that tell what has become of them, and contact sheets of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/frame.h"
#include "tests/checks/check.h"

namespace ballpit::check {

// Even, as H.264 wants it, and else as odd as can be: a row of 3 bytes a pixel is no multiple of 4,
// one of 4 bytes no multiple of 16.
constexpr int testWidth = 118, testHeight = 74;

struct Color {
    int r, g, b;
};
constexpr Color red{220, 40, 30}, green{40, 200, 60}, blue{40, 70, 230}, yellow{230, 210, 40};
constexpr Color grey{128, 128, 128}, white{250, 250, 250}, black{6, 6, 6};

inline std::string text(Color c) {
    return "(" + text(c.r) + ", " + text(c.g) + ", " + text(c.b) + ")";
}

inline Color colorAt(const Frame& frame, int x, int y) {
    const std::size_t at = 3 * static_cast<std::size_t>(y * frame.width + x);
    return {frame.rgb[at], frame.rgb[at + 1], frame.rgb[at + 2]};
}

inline bool isNear(Color a, Color b, int tolerance) {
    return std::abs(a.r - b.r) <= tolerance && std::abs(a.g - b.g) <= tolerance &&
           std::abs(a.b - b.b) <= tolerance;
}

inline void paint(Frame& frame, int left, int top, int right, int bottom, Color color) {
    for (int y = std::max(top, 0); y < std::min(bottom, frame.height); ++y)
        for (int x = std::max(left, 0); x < std::min(right, frame.width); ++x) {
            const std::size_t at = 3 * static_cast<std::size_t>(y * frame.width + x);
            frame.rgb[at] = static_cast<std::uint8_t>(color.r);
            frame.rgb[at + 1] = static_cast<std::uint8_t>(color.g);
            frame.rgb[at + 2] = static_cast<std::uint8_t>(color.b);
        }
}

inline Frame blank(int width, int height, Color color) {
    Frame frame{width, height,
                std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * height)};
    paint(frame, 0, 0, width, height, color);
    return frame;
}

// ---- the frame of the checks: a patch in each corner, its number as a bar code in the middle

constexpr int patchWidth = 24, patchHeight = 20, barWidth = 12, barBits = 6;
constexpr int barLeft = 24, barTop = 28, barBottom = 46;

inline Frame numberedFrame(int number) {
    Frame frame = blank(testWidth, testHeight, grey);
    paint(frame, 0, 0, patchWidth, patchHeight, red);
    paint(frame, testWidth - patchWidth, 0, testWidth, patchHeight, green);
    paint(frame, 0, testHeight - patchHeight, patchWidth, testHeight, blue);
    paint(frame, testWidth - patchWidth, testHeight - patchHeight, testWidth, testHeight, yellow);
    for (int bit = 0; bit < barBits; ++bit) {
        const int left = barLeft + barWidth * (barBits - 1 - bit);
        paint(frame, left, barTop, left + barWidth, barBottom, number >> bit & 1 ? white : black);
    }
    return frame;
}

/// The number in the bar code; -1 if there is none.
inline int numberIn(const Frame& frame) {
    int number = 0;
    for (int bit = 0; bit < barBits; ++bit) {
        const int x = barLeft + barWidth * (barBits - 1 - bit) + barWidth / 2;
        const Color color = colorAt(frame, x, (barTop + barBottom) / 2);
        if (!isNear(color, white, 60) && !isNear(color, black, 60)) return -1;
        number |= (color.g > 128) << bit;
    }
    return number;
}

struct Corner {
    const char* name;
    int x, y;
    Color color;
};
inline const std::vector<Corner> corners{
    {"top left", patchWidth / 2, patchHeight / 2, red},
    {"top right", testWidth - patchWidth / 2, patchHeight / 2, green},
    {"bottom left", patchWidth / 2, testHeight - patchHeight / 2, blue},
    {"bottom right", testWidth - patchWidth / 2, testHeight - patchHeight / 2, yellow}};

// ---- contact sheets

constexpr int sheetColumns = 3, sheetRows = 4, sheetFrames = sheetColumns * sheetRows, gap = 6;

inline void place(Frame& sheet, const Frame& picture, int left, int top) {
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            paint(sheet, left + x, top + y, left + x + 1, top + y + 1, colorAt(picture, x, y));
}

/// The frame where it differs from the other in red, on a faint copy of the other.
inline Frame errorsOf(const Frame& got, const Frame& expected) {
    Frame errors = blank(expected.width, expected.height, white);
    for (int y = 0; y < expected.height; ++y)
        for (int x = 0; x < expected.width; ++x) {
            const Color right = colorAt(expected, x, y);
            const bool same =
                x < got.width && y < got.height && isNear(colorAt(got, x, y), right, 60);
            const Color faint{224 + right.r / 8, 224 + right.g / 8, 224 + right.b / 8};
            paint(
                errors, x, y, x + 1, y + 1,
                same ? Color{std::min(faint.r, 255), std::min(faint.g, 255), std::min(faint.b, 255)}
                     : red);
        }
    return errors;
}

/// Three sheets side by side: yours, reference, errors. Twelve frames from the first to the last;
/// one that is missing leaves its place empty.
inline Frame contactSheets(const std::vector<Frame>& got, const std::vector<Frame>& expected) {
    const int width = sheetColumns * (testWidth + gap), height = sheetRows * (testHeight + gap);
    constexpr int margin = 14;
    Frame sheet = blank(3 * width + 4 * margin, height + 2 * margin, white);
    const Frame missing = blank(testWidth, testHeight, {226, 226, 228});
    for (std::size_t k = 0; k < sheetFrames; ++k) {
        const std::size_t number = k * (expected.size() - 1) / (sheetFrames - 1);
        const Frame& yours = number < got.size() ? got[number] : missing;
        const int x = margin + static_cast<int>(k) % sheetColumns * (testWidth + gap);
        const int y = margin + static_cast<int>(k) / sheetColumns * (testHeight + gap);
        place(sheet, yours, x, y);
        place(sheet, expected[number], x + width + margin, y);
        place(sheet, errorsOf(yours, expected[number]), x + 2 * (width + margin), y);
    }
    return sheet;
}

}  // namespace ballpit::check
