// Draws the stage. The shade is painted from above into a texture that the floor is covered with.
#include "08_sphere_rendering/stage.h"

#include "08_sphere_rendering/floor_shaders.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ballpit {
namespace {

constexpr int longestSide = 1024;  // texels along the floor's longer side
/// Of more balls only some cast shade: their blobs lie on each other anyway, and blending a million
/// of them took an H100 longer than drawing the balls.
constexpr std::size_t mostShades = 100'000;

void vertex(Vec3 p) { glVertex3f(p.x, p.y, p.z); }

/// A round number (1, 2 or 5 times a power of ten) that divides the length into 6 to 15 cells.
float gridSpacing(float length) {
    const float decade = std::pow(10.0f, std::floor(std::log10(length / 6.0f)));
    const float steps = length / 6.0f / decade;
    return decade * (steps < 2.0f ? 1.0f : steps < 5.0f ? 2.0f : 5.0f);
}

int texelsAlong(float side, float longest) {
    const auto texels = static_cast<int>(static_cast<float>(longestSide) * side / longest);
    return std::clamp(texels, 16, longestSide);
}

}  // namespace

Stage::Stage(Bounds world)
    : world_(world),
      floorProgram_(floorVertexShader, floorFragmentShader),
      quadShade_(quadShadeVertexShader(), shadeFragmentShader),
      pointShade_(pointShadeVertexShader(), shadeFragmentShader) {
    const Vec3 size = extent(world);
    texelsX_ = texelsAlong(size.x, std::max(size.x, size.z));
    texelsZ_ = texelsAlong(size.z, std::max(size.x, size.z));
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, texelsX_, texelsZ_, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 nullptr);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL cannot draw into a texture");
}

Stage::~Stage() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
}

void Stage::bindTexture() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, texelsX_, texelsZ_);
}

void Stage::forgetShade() {
    bindTexture();
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
}

template <class Draw>
void Stage::paintShade(const OpenGLProgram& program, Draw drawSquares) {
    forgetShade();
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glBlendEquation(GL_MAX);
    program.use();
    const Vec3 size = extent(world_);
    program.set("floorCorner", world_.lower);
    program.set("floorSize", size.x, size.z);
    program.set("texels", static_cast<float>(texelsX_), static_cast<float>(texelsZ_));
    drawSquares();
    glUseProgram(0);
    glBlendEquation(GL_FUNC_ADD);
    glPopAttrib();
}

void Stage::shade(const BallQuads& quads) {
    paintShade(quadShade_, [&] { quads.drawSquares(); });
}
void Stage::shade(const BallPoints& points) {
    paintShade(pointShade_, [&] { points.drawSquares(mostShades); });
}

void Stage::drawBackground() const {
    glPushMatrix();
    glLoadIdentity();
    glMatrixMode(GL_PROJECTION);
    glPushMatrix();
    glLoadIdentity();
    glBegin(GL_QUADS);
    glColor3f(0.93f, 0.94f, 0.95f);
    glVertex2f(-1.0f, -1.0f);
    glVertex2f(1.0f, -1.0f);
    glColor3f(0.70f, 0.78f, 0.88f);
    glVertex2f(1.0f, 1.0f);
    glVertex2f(-1.0f, 1.0f);
    glEnd();
    glPopMatrix();
    glMatrixMode(GL_MODELVIEW);
    glPopMatrix();
}

void Stage::drawFloor(bool grid) const {
    const auto [lower, upper] = world_;
    const Vec3 size = extent(world_);
    const float spacing = gridSpacing(std::max(size.x, size.z));
    glEnable(GL_POLYGON_OFFSET_FILL);  // else the floor hides half of the lines that lie on it
    glPolygonOffset(3.0f, 3.0f);
    glBindTexture(GL_TEXTURE_2D, texture_);
    floorProgram_.use();
    floorProgram_.setTexture("shade", 0);
    floorProgram_.set("grid", grid ? 1.0f : 0.0f);
    const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    glBegin(GL_QUADS);
    for (const auto& [x, z] : corners) {
        glMultiTexCoord2f(GL_TEXTURE0, x * size.x / spacing, z * size.z / spacing);
        glMultiTexCoord2f(GL_TEXTURE1, x, z);
        glVertex3f(lower.x + x * size.x, lower.y, lower.z + z * size.z);
    }
    glEnd();
    glUseProgram(0);
    glBindTexture(GL_TEXTURE_2D, 0);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

void Stage::drawLines() const {
    const Vec3 size = extent(world_);
    glEnable(GL_LINE_SMOOTH);
    glLineWidth(1.5f);
    glColor4f(0.25f, 0.30f, 0.40f, 0.45f);
    glBegin(GL_LINES);
    for (int i = 0; i < 4; ++i) {
        const float a = i & 1 ? 1.0f : 0.0f, b = i & 2 ? 1.0f : 0.0f;
        vertex(world_.lower + Vec3{0.0f, a * size.y, b * size.z});
        vertex(world_.lower + Vec3{size.x, a * size.y, b * size.z});
        vertex(world_.lower + Vec3{a * size.x, 0.0f, b * size.z});
        vertex(world_.lower + Vec3{a * size.x, size.y, b * size.z});
        vertex(world_.lower + Vec3{a * size.x, b * size.y, 0.0f});
        vertex(world_.lower + Vec3{a * size.x, b * size.y, size.z});
    }
    glEnd();
    // x, y and z in red, green and blue, from the box's lower corner.
    const float reach = 0.15f * std::max({size.x, size.y, size.z});
    glLineWidth(4.0f);
    glBegin(GL_LINES);
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const Vec3 color = Vec3{0.08f, 0.08f, 0.08f} + 0.75f * axis;
        glColor3f(color.x, color.y, color.z);
        vertex(world_.lower);
        vertex(world_.lower + reach * axis);
    }
    glEnd();
}

}  // namespace ballpit
