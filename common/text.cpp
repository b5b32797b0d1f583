// Glyphs by FreeType, drawn as textured squares by OpenGL 1.1's fixed functions.
#include "common/text.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <iostream>
#include <sstream>

namespace ballpit {
namespace {

/// A font file that is open; `face` is null if none was found.
struct Font {
    Font() {
        if (FT_Init_FreeType(&library) != 0) return;
        if (const char* chosen = std::getenv("BALLPIT_FONT")) {
            open(chosen);
            return;
        }
        for (const char* folder : {"truetype/dejavu", "dejavu-sans-mono-fonts", "TTF"})
            if (open(std::string("/usr/share/fonts/") + folder + "/DejaVuSansMono.ttf")) return;
    }
    ~Font() {
        if (face) FT_Done_Face(face);
        if (library) FT_Done_FreeType(library);
    }
    Font(const Font&) = delete;

    bool open(const std::string& path) {
        if (FT_New_Face(library, path.c_str(), 0, &face) != 0) face = nullptr;
        return face != nullptr;
    }

    FT_Library library = nullptr;
    FT_Face face = nullptr;
};

void noteMissingFont() {
    static std::atomic<bool> noted = false;
    if (noted.exchange(true)) return;
    std::cerr << "note: no font, so no text on frames: install fonts-dejavu-core, or name a "
                 "monospaced font file in BALLPIT_FONT\n";
}

/// Copies the glyph that `face` has just rendered to where its cell begins.
void copyGlyph(const FT_GlyphSlot glyph, int left, int baseline, GlyphSheet& sheet) {
    const FT_Bitmap& bitmap = glyph->bitmap;
    const int rowBytes = GlyphSheet::count * sheet.cellWidth;
    for (int row = 0; row < static_cast<int>(bitmap.rows); ++row)
        for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
            const int x = glyph->bitmap_left + column, y = baseline - glyph->bitmap_top + row;
            if (x < 0 || x >= sheet.cellWidth || y < 0 || y >= sheet.cellHeight) continue;
            sheet.coverage[static_cast<std::size_t>(y * rowBytes + left + x)] =
                bitmap.buffer[row * bitmap.pitch + column];
        }
}

struct Size {
    int columns = 0, lines = 0;
};

Size sizeOf(const std::string& text) {
    Size size;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line); ++size.lines)
        size.columns = std::max(size.columns, static_cast<int>(line.size()));
    return size;
}

void rectangle(float left, float top, float right, float bottom) {
    for (const auto& [x, y] : std::array<std::array<float, 2>, 4>{
             {{left, top}, {right, top}, {right, bottom}, {left, bottom}}})
        glVertex2f(x, y);
}

/// For its lifetime, x and y are pixels from the frame's top-left corner, and what is drawn blends
/// with what is there.
struct PixelDrawing {
    PixelDrawing(int width, int height) {
        glPushAttrib(GL_ALL_ATTRIB_BITS);
        glUseProgram(0);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glDisable(GL_LIGHTING);
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        glEnable(GL_BLEND);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        glViewport(0, 0, width, height);
        glMatrixMode(GL_PROJECTION);
        glPushMatrix();
        glLoadIdentity();
        glOrtho(0, width, height, 0, -1, 1);
        glMatrixMode(GL_MODELVIEW);
        glPushMatrix();
        glLoadIdentity();
    }
    ~PixelDrawing() {
        glPopMatrix();
        glMatrixMode(GL_PROJECTION);
        glPopMatrix();
        glPopAttrib();
    }
    PixelDrawing(const PixelDrawing&) = delete;
};

}  // namespace

std::optional<GlyphSheet> renderGlyphs(int lineHeight) {
    const Font font;
    if (!font.face) {
        noteMissingFont();
        return std::nullopt;
    }
    // A line of DejaVu is 1.17 em high. The rest is room between the lines.
    const auto em = static_cast<FT_UInt>(std::max(1.0, 0.82 * lineHeight));
    FT_Set_Pixel_Sizes(font.face, 0, em);
    FT_Load_Char(font.face, 'M', FT_LOAD_TARGET_LIGHT);
    GlyphSheet sheet{static_cast<int>(font.face->glyph->advance.x >> 6), lineHeight, {}};
    sheet.coverage.resize(
        static_cast<std::size_t>(GlyphSheet::count * sheet.cellWidth * lineHeight));
    const int baseline = static_cast<int>(0.78 * lineHeight);
    for (int k = 0; k < GlyphSheet::count; ++k) {
        const auto character = static_cast<FT_ULong>(GlyphSheet::first + k);
        if (FT_Load_Char(font.face, character, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) == 0)
            copyGlyph(font.face->glyph, k * sheet.cellWidth, baseline, sheet);
    }
    return sheet;
}

int lineHeightFor(int width, int height) {
    constexpr int smallest = 12, largest = 80, lines = 38, halfColumns = 60;
    return std::clamp(std::min(height / lines, width / halfColumns), smallest, largest);
}

std::string fitted(const std::string& text, int lines) {
    std::vector<std::string> kept;
    std::istringstream all(text);
    for (std::string line; std::getline(all, line);) kept.push_back(line);
    const auto tooMany = [&] { return static_cast<int>(kept.size()) > lines; };
    if (tooMany()) std::erase(kept, std::string());
    if (tooMany()) std::erase_if(kept, [](const std::string& line) { return line[0] == ' '; });
    if (tooMany()) kept.resize(static_cast<std::size_t>(std::max(0, lines)));
    std::string result;
    for (const std::string& line : kept) result += line + '\n';
    return result;
}

struct TextPainter::Texture {
    explicit Texture(const GlyphSheet& sheet) {
        glGenTextures(1, &name);
        glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glBindTexture(GL_TEXTURE_2D, name);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA8, GlyphSheet::count * sheet.cellWidth,
                     sheet.cellHeight, 0, GL_ALPHA, GL_UNSIGNED_BYTE, sheet.coverage.data());
        glBindTexture(GL_TEXTURE_2D, 0);
        glPopClientAttrib();
    }
    ~Texture() { glDeleteTextures(1, &name); }
    Texture(const Texture&) = delete;

    GLuint name = 0;
};

TextPainter::TextPainter() = default;
TextPainter::~TextPainter() = default;

void TextPainter::prepare(int lineHeight) {
    if (lineHeight == preparedHeight_) return;
    preparedHeight_ = lineHeight;
    glyphs_ = renderGlyphs(lineHeight);
    texture_ = glyphs_ ? std::make_unique<Texture>(*glyphs_) : nullptr;
}

namespace {

/// A textured square for each character, from (left, top) on. Between glBegin and glEnd.
void drawCharacters(const std::string& text, const GlyphSheet& glyphs, int left, int top) {
    int x = left, y = top;
    for (const char character : text) {
        if (character == '\n') {
            x = left;
            y += glyphs.cellHeight;
            continue;
        }
        const bool known = character >= GlyphSheet::first && character <= '~';
        const int k = (known ? character : '?') - GlyphSheet::first;
        const float from = static_cast<float>(k) / GlyphSheet::count;
        const float to = static_cast<float>(k + 1) / GlyphSheet::count;
        glTexCoord2f(from, 0), glVertex2i(x, y);
        glTexCoord2f(to, 0), glVertex2i(x + glyphs.cellWidth, y);
        glTexCoord2f(to, 1), glVertex2i(x + glyphs.cellWidth, y + glyphs.cellHeight);
        glTexCoord2f(from, 1), glVertex2i(x, y + glyphs.cellHeight);
        x += glyphs.cellWidth;
    }
}

}  // namespace

void TextPainter::draw(const std::string& text, Place place, int width, int height) {
    const int lineHeight = lineHeightFor(width, height), margin = lineHeight / 2;
    const std::string shown = fitted(text, (height - 2 * margin) / lineHeight);
    const auto [columns, lines] = sizeOf(shown);
    if (columns == 0) return;
    prepare(lineHeight);
    if (!glyphs_) return;

    const int textWidth = columns * glyphs_->cellWidth, textHeight = lines * glyphs_->cellHeight;
    int left = 2 * margin, top = margin;
    if (place == Place::center) {
        left = (width - textWidth) / 2;
        top = (height - textHeight) / 2;
    }

    const PixelDrawing drawing(width, height);
    glBegin(GL_QUADS);
    glColor4f(0.08f, 0.10f, 0.14f, place == Place::center ? 0.88f : 0.66f);
    rectangle(static_cast<float>(left - margin), static_cast<float>(top - margin / 2),
              static_cast<float>(left + textWidth + margin),
              static_cast<float>(top + textHeight + margin / 2));
    glEnd();
    glEnable(GL_TEXTURE_2D);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
    glBindTexture(GL_TEXTURE_2D, texture_->name);
    glBegin(GL_QUADS);
    glColor4f(1.0f, 1.0f, 1.0f, 1.0f);
    drawCharacters(shown, *glyphs_, left, top);
    glEnd();
}

}  // namespace ballpit
