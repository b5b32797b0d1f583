// Text on frames: what fits, how the glyphs look, and that they are drawn the right way up.
#include "common/text.h"

#include "08_sphere_rendering/sphere_renderer.h"
#include "common/offscreen_context.h"
#include "tests/catch.h"

#include <algorithm>
#include <cstdlib>

using namespace ballpit;

namespace {

constexpr Bounds world{{-5.0f, -5.0f, -5.0f}, {5.0f, 5.0f, 5.0f}};

/// How much of a row of a glyph's cell is covered.
int ink(const GlyphSheet& sheet, char glyph, int row) {
    const int left = (glyph - GlyphSheet::first) * sheet.cellWidth;
    const auto start = sheet.coverage.begin() + row * GlyphSheet::count * sheet.cellWidth + left;
    int sum = 0;
    for (auto byte = start; byte != start + sheet.cellWidth; ++byte) sum += *byte;
    return sum;
}

/// White pixels of a frame: columns from `left`, rows from `top`, 100 by 60.
int whitePixels(const Frame& frame, int left, int top) {
    int count = 0;
    for (int row = top; row < top + 60; ++row)
        for (int column = left; column < left + 100; ++column) {
            const auto* pixel =
                &frame.rgb[static_cast<std::size_t>(3 * (row * frame.width + column))];
            count += *std::min_element(pixel, pixel + 3) > 220;
        }
    return count;
}

Frame draw(const std::string& text, TextPainter::Place place) {
    constexpr int width = 640, height = 360;
    SphereRenderer renderer(world, width, height);
    renderer.draw({}, {}, {});
    TextPainter painter;
    painter.draw(text, place, width, height);
    return renderer.read();
}

}  // namespace

TEST_CASE("text that is too long loses empty lines first, then indented ones, then its end") {
    const std::string text = "a\n\n  b\nc\nd\n";
    CHECK(fitted(text, 5) == text);
    CHECK(fitted(text, 4) == "a\n  b\nc\nd\n");
    CHECK(fitted(text, 3) == "a\nc\nd\n");
    CHECK(fitted(text, 2) == "a\nc\n");
    CHECK(fitted(text, 0).empty());
    CHECK(fitted("", 3).empty());
}

TEST_CASE("letters are the same share of every frame, but never too small to read") {
    CHECK(lineHeightFor(1920, 1080) == 28);
    CHECK(lineHeightFor(3840, 2160) == 56);
    CHECK(lineHeightFor(320, 180) == 12);
    CHECK(lineHeightFor(400, 2000) == 12);  // a narrow window
    CHECK(lineHeightFor(8192, 8192) == 80);
}

TEST_CASE("glyphs stand upright on their line, each in its cell") {
    const auto sheet = renderGlyphs(28);
    REQUIRE(sheet.has_value());
    CHECK(sheet->cellHeight == 28);
    CHECK(sheet->coverage.size() == std::size_t(28 * sheet->cellWidth * GlyphSheet::count));
    const auto share = [&](char glyph, int from, int to) {
        int sum = 0;
        for (int row = from; row < to; ++row) sum += ink(*sheet, glyph, row);
        return sum;
    };
    CHECK(share(' ', 0, 28) == 0);
    CHECK(share('^', 0, 14) > 0);
    CHECK(share('^', 14, 28) == 0);
    CHECK(share('_', 0, 20) == 0);
    CHECK(share('_', 20, 28) > 0);
    CHECK(share('T', 0, 9) > share('T', 14, 23));  // the bar is on top
    CHECK(ink(*sheet, 'M', 0) == 0);               // room between the lines
    CHECK(ink(*sheet, 'g', 27) == 0);
}

TEST_CASE("text is drawn over the frame, upright, where it is asked for") {
    const OffscreenContext context;
    const Frame empty = draw("", TextPainter::Place::topLeft);
    const Frame top = draw("#####\n#####", TextPainter::Place::topLeft);
    const Frame middle = draw("#####\n#####\n#####", TextPainter::Place::center);
    CHECK(whitePixels(empty, 0, 0) == 0);
    CHECK(whitePixels(top, 0, 0) > 20);
    CHECK(whitePixels(top, 270, 150) == whitePixels(empty, 270, 150));
    CHECK(whitePixels(middle, 270, 150) > 20);
    CHECK(draw("     ", TextPainter::Place::topLeft).rgb != empty.rgb);  // the panel

    // Upright: of "^" over "_", the second is farther down and the first farther up.
    const auto firstAndLastRow = [&](const std::string& text) {
        const Frame with = draw(text, TextPainter::Place::topLeft);
        const Frame without = draw(" ", TextPainter::Place::topLeft);
        int first = -1, last = -1;
        for (int row = 0; row < 60; ++row)
            for (int column = 0; column < 60; ++column) {
                const auto k = static_cast<std::size_t>(3 * (row * with.width + column));
                if (with.rgb[k] < without.rgb[k] + 40) continue;
                if (first < 0) first = row;
                last = row;
            }
        return std::pair(first, last);
    };
    CHECK(firstAndLastRow("^").second < firstAndLastRow("_").first);
}

TEST_CASE("drawing text leaves no trace in how the next frame is drawn") {
    const OffscreenContext context;
    SphereRenderer renderer(world, 320, 180);
    const std::vector<Vec3> place{{0, 0, 0}}, color{{1, 0, 0}};
    const std::vector<float> radius{2.0f};
    renderer.draw(place, radius, color);
    const Frame before = renderer.read();
    TextPainter painter;
    painter.draw("text", TextPainter::Place::topLeft, 320, 180);
    renderer.draw(place, radius, color);
    CHECK(renderer.read().rgb == before.rgb);
}

TEST_CASE("without a font there is no text, and everything else goes on") {
    setenv("BALLPIT_FONT", "/nowhere.ttf", 1);
    CHECK(!renderGlyphs(20).has_value());
    {
        const OffscreenContext context;
        CHECK(draw("text", TextPainter::Place::topLeft).rgb ==
              draw("", TextPainter::Place::topLeft).rgb);
    }
    unsetenv("BALLPIT_FONT");
    CHECK(renderGlyphs(20).has_value());
}
