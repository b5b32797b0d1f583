// The colours that tell something: of a ball's speed, contacts, cell and place in memory.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/coloring.h"
#include "common/error.h"
#include "tests/catch.h"

using namespace ballpit;

namespace {

/// How bright a colour looks (BT.709).
float brightness(Vec3 color) { return dot(color, {0.2126f, 0.7152f, 0.0722f}); }

/// How a red-blind eye sees a colour: the two values that it has left (Vienot et al. 1999, without
/// the display's gamma, which is enough to see whether two colours fall together).
std::array<float, 2> seenWithoutRed(Vec3 color) {
    return {0.11238f * color.x + 0.88762f * color.y,
            0.00401f * color.x - 0.00401f * color.y + color.z};
}

float farthestComponent(std::array<float, 2> a, std::array<float, 2> b) {
    return std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1]));
}

Spheres ballsInARow(int count) {
    Spheres balls;
    for (int k = 0; k < count; ++k)
        balls.add({static_cast<float>(k), 0, 0}, {static_cast<float>(k), 0, 0}, 0.5f, 1.0f, 1.0f,
                  paletteColor(static_cast<std::size_t>(k)));
    return balls;
}

}  // namespace

TEST_CASE("colouring by body leaves every ball its own colour") {
    const Spheres balls = ballsInARow(5);
    CHECK(colorsBy(ColorBy::body, {balls}) == balls.colors);
}

TEST_CASE("a faster ball is brighter, up to the top speed and no further") {
    const Spheres balls = ballsInARow(12);  // ball k at k m/s
    const auto colors = colorsBy(ColorBy::speed, {.balls = balls, .topSpeed = 10.0f});
    REQUIRE(colors.size() == 12);
    for (std::size_t k = 1; k <= 10; ++k) {
        CAPTURE(k);
        CHECK(brightness(colors[k]) > brightness(colors[k - 1]) + 0.03f);
    }
    CHECK(colors[11] == colors[10]);
}

TEST_CASE("a speed that is no number gets the colour of rest") {
    CHECK(speedColor(std::numeric_limits<float>::quiet_NaN()) == speedColor(0.0f));
    CHECK(speedColor(std::numeric_limits<float>::infinity()) == speedColor(1.0f));
}

TEST_CASE("a ball's contacts are counted from both sides of its pairs") {
    const Spheres balls = ballsInARow(4);
    const std::vector<Pair> pairs{{0, 1}, {1, 2}};
    const auto colors = colorsBy(ColorBy::contacts, {.balls = balls, .pairs = pairs});
    CHECK(colors ==
          std::vector{contactColor(1), contactColor(2), contactColor(1), contactColor(0)});
}

TEST_CASE("more contacts are warmer and darker; none is grey") {
    const Vec3 none = contactColor(0);
    CHECK(std::max({none.x, none.y, none.z}) - std::min({none.x, none.y, none.z}) < 0.1f);
    for (std::size_t contacts = 2; contacts <= 6; ++contacts) {
        CAPTURE(contacts);
        CHECK(brightness(contactColor(contacts)) < brightness(contactColor(contacts - 1)) - 0.03f);
        CHECK(contactColor(contacts).x > contactColor(contacts).z + 0.4f);
    }
    CHECK(contactColor(100) == contactColor(6));
}

TEST_CASE("all cells around a cell have other colours than it, also across zero") {
    for (const Int3 cell : {Int3{0, 0, 0}, Int3{5, 2, 7}, Int3{-1, -4, 0}})
        for (int k = 0; k < 27; ++k) {
            const Int3 other{cell.x + k % 3 - 1, cell.y + k / 3 % 3 - 1, cell.z + k / 9 - 1};
            CAPTURE(cell.x, cell.y, cell.z, k);
            CHECK((cellColor(other) == cellColor(cell)) == (k == 13));
        }
}

TEST_CASE("the eight colours of cells can be told apart without red light") {
    for (int a = 0; a < 8; ++a)
        for (int b = 0; b < a; ++b) {
            CAPTURE(a, b);
            const auto seen = [](int k) {
                return seenWithoutRed(cellColor({k & 1, k >> 1 & 1, k >> 2}));
            };
            CHECK(farthestComponent(seen(a), seen(b)) > 0.08f);
        }
}

TEST_CASE("a cell begins at the grid's origin, and a ball at a face belongs to the upper cell") {
    Spheres balls;
    for (const float x : {-3.0f, -2.1f, -2.0f, 0.9f, 1.0f}) balls.add({x, 0, 0}, {}, 0.1f, 1, 1);
    const auto colors =
        colorsBy(ColorBy::cell, {.balls = balls, .gridOrigin = {-5, -1, -1}, .cellSize = 3.0f});
    CHECK(colors[0] == colors[1]);
    CHECK(colors[1] != colors[2]);
    CHECK(colors[2] == colors[3]);
    CHECK(colors[3] != colors[4]);
}

TEST_CASE("the ball of the first slot is blue, that of the last orange, whatever its number") {
    const Spheres balls = ballsInARow(4);
    const std::vector<std::uint32_t> order{2, 0, 3, 1};
    const auto colors = colorsBy(ColorBy::memory, {.balls = balls, .memoryOrder = order});
    for (std::size_t slot = 1; slot < 4; ++slot) {
        CHECK(colors[order[slot]].x > colors[order[slot - 1]].x);
        CHECK(colors[order[slot]].z < colors[order[slot - 1]].z);
    }
    CHECK(colors[2] == rampColor(0.0f));
}

TEST_CASE("colourings are found by name, follow each other in a ring, and others are refused") {
    for (const ColorBy by : allColorings) CHECK(coloringNamed(name(by)) == by);
    CHECK(nextColoring(ColorBy::body) == ColorBy::speed);
    CHECK(nextColoring(ColorBy::memory) == ColorBy::body);
    CHECK_THROWS_AS(coloringNamed("colour"), InputError);
}
