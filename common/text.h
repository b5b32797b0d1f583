// Text on frames, the same in a window and offscreen: a font's glyphs in one texture.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ballpit {

/// The printable ASCII characters (32 to 126) of DejaVu Sans Mono, side by side in one row of equal
/// cells; a byte says how much of a pixel the glyph covers. Row 0 is the top one.
struct GlyphSheet {
    static constexpr int first = 32, count = 95;
    int cellWidth = 0, cellHeight = 0;  ///< pixels
    std::vector<std::uint8_t> coverage;
};

/// Glyphs whose lines are `lineHeight` pixels apart. Nothing, with one note on stderr in a process,
/// if no font is found: $BALLPIT_FONT or where distributions put DejaVu Sans Mono.
std::optional<GlyphSheet> renderGlyphs(int lineHeight);

/// How far apart lines of text are in a frame of this size, pixels: the same share of small and
/// large frames, so that a window on a fine screen has larger letters, but never too small to read.
int lineHeightFor(int width, int height);

/// The text in at most `lines` lines: if it has more, its empty lines go first, then indented ones,
/// then what is at the end.
std::string fitted(const std::string& text, int lines);

/// Draws text over the framebuffer that is bound. Needs the OpenGL context it was made in.
class TextPainter {
public:
    TextPainter();
    ~TextPainter();
    TextPainter(const TextPainter&) = delete;

    enum class Place { topLeft, center };

    /// The lines of `text` on a dark, translucent panel. Characters that are not printable ASCII
    /// become "?". What has no room in the frame is left out, as by
    /// fitted(). Without a font, or without text, nothing is drawn.
    void draw(const std::string& text, Place place, int width, int height);

private:
    struct Texture;
    void prepare(int lineHeight);

    int preparedHeight_ = 0;
    std::optional<GlyphSheet> glyphs_;
    std::unique_ptr<Texture> texture_;
};

}  // namespace ballpit
