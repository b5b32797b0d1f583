// The passes that make a picture: background, floor, shadows, balls, edges, axes.
#include "08_sphere_rendering/sphere_renderer.h"

#include "08_sphere_rendering/sphere_shaders.h"

#include "common/error.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace ballpit {
namespace {

// ---- OpenGL helpers

GLuint compileShader(GLenum kind, const std::string& source) {
    const GLuint shader = glCreateShader(kind);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    return shader;
}

/// Links a program whose attributes 0, 1 and 2 are `ball`, `color` and `corner`.
GLuint linkProgram(const std::string& vertexSource, const std::string& fragmentSource) {
    const GLuint vertexShader = compileShader(GL_VERTEX_SHADER, vertexSource);
    const GLuint fragmentShader = compileShader(GL_FRAGMENT_SHADER, fragmentSource);
    const GLuint program = glCreateProgram();
    glAttachShader(program, vertexShader);
    glAttachShader(program, fragmentShader);
    glBindAttribLocation(program, 0, "ball");
    glBindAttribLocation(program, 1, "color");
    glBindAttribLocation(program, 2, "corner");
    glLinkProgram(program);
    glDeleteShader(vertexShader);
    glDeleteShader(fragmentShader);

    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked) return program;
    std::array<char, 1024> log{};
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    glDeleteProgram(program);
    throw std::runtime_error(std::string("the driver refused a shader: ") + log.data());
}

GLint uniform(GLuint program, const char* name) { return glGetUniformLocation(program, name); }

void setVector(GLuint program, const char* name, Vec3 value) {
    glUniform3f(uniform(program, name), value.x, value.y, value.z);
}

void vertex(Vec3 p) { glVertex3f(p.x, p.y, p.z); }

/// A round number (1, 2 or 5 times a power of ten) that divides the length into 6 to 15 cells.
float gridSpacing(float length) {
    const float decade = std::pow(10.0f, std::floor(std::log10(length / 6.0f)));
    const float steps = length / 6.0f / decade;
    return decade * (steps < 2.0f ? 1.0f : steps < 5.0f ? 2.0f : 5.0f);
}

}  // namespace

struct SphereRenderer::OpenGLObjects {
    GLuint ballProgram = 0, shadowProgram = 0, floorProgram = 0;
    GLuint vertices = 0, framebuffer = 0;
    std::array<GLuint, 2> renderbuffers{};  // colour, depth

    OpenGLObjects() = default;
    OpenGLObjects(const OpenGLObjects&) = delete;
    OpenGLObjects& operator=(const OpenGLObjects&) = delete;
    ~OpenGLObjects() {
        for (const GLuint program : {ballProgram, shadowProgram, floorProgram})
            glDeleteProgram(program);
        glDeleteBuffers(1, &vertices);
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteRenderbuffers(2, renderbuffers.data());
    }

    void makePrograms() {
        ballProgram = linkProgram(ballVertexShader, ballFragmentShader);
        shadowProgram = linkProgram(shadowVertexShader, shadowFragmentShader);
        floorProgram = linkProgram(floorVertexShader, floorFragmentShader);
    }

    void makeFramebuffer(int width, int height) {
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glGenRenderbuffers(2, renderbuffers.data());
        attach(GL_COLOR_ATTACHMENT0, renderbuffers[0], GL_RGBA8, width, height);
        attach(GL_DEPTH_ATTACHMENT, renderbuffers[1], GL_DEPTH_COMPONENT24, width, height);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
        throw InputError("OpenGL cannot draw frames of " + std::to_string(width) + "x" +
                         std::to_string(height) + "; choose a smaller size");
    }

    static void attach(GLenum role, GLuint buffer, GLenum format, int width, int height) {
        glBindRenderbuffer(GL_RENDERBUFFER, buffer);
        glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, role, GL_RENDERBUFFER, buffer);
    }
};

SphereRenderer::SphereRenderer(Bounds world, int width, int height)
    : camera(frameWorld(world)), world_(world), width_(width), height_(height) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
    if (width < 1 || height < 1 || width > limit || height > limit)
        throw InputError("frame size " + std::to_string(width) + "x" + std::to_string(height) +
                         ": width and height must be from 1 to " + std::to_string(limit));
    gl_ = std::make_unique<OpenGLObjects>();
    gl_->makePrograms();
    gl_->makeFramebuffer(width, height);
    glGenBuffers(1, &gl_->vertices);
}

SphereRenderer::~SphereRenderer() = default;

void SphereRenderer::resize(int width, int height) {
    width_ = width;
    height_ = height;
    glBindFramebuffer(GL_FRAMEBUFFER, gl_->framebuffer);
    gl_->attach(GL_COLOR_ATTACHMENT0, gl_->renderbuffers[0], GL_RGBA8, width, height);
    gl_->attach(GL_DEPTH_ATTACHMENT, gl_->renderbuffers[1], GL_DEPTH_COMPONENT24, width, height);
}

unsigned SphereRenderer::framebuffer() const { return gl_->framebuffer; }

void SphereRenderer::draw(std::span<const Vec3> positions, std::span<const float> radii,
                          std::span<const Vec3> colors) {
    if (radii.size() != positions.size() || colors.size() != positions.size())
        throw std::invalid_argument("draw: positions, radii and colors differ in number");
    loadMatrices();
    sortFarthestFirst(positions, radii, colors);
    uploadQuads();

    glBindFramebuffer(GL_FRAMEBUFFER, gl_->framebuffer);
    glViewport(0, 0, width_, height_);
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);

    drawBackground();
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_POLYGON_OFFSET_FILL);  // else the floor hides half of the lines that lie on it
    glPolygonOffset(3.0f, 3.0f);
    if (style.floorGrid) drawFloor();
    glDisable(GL_POLYGON_OFFSET_FILL);
    // Shadows fall only where the floor is: where the depth is less than the background's.
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_GREATER);
    drawQuads(gl_->shadowProgram);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    if (style.wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    drawQuads(gl_->ballProgram);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    // Lines last: their soft borders blend with what is behind them.
    glDepthMask(GL_FALSE);
    glEnable(GL_LINE_SMOOTH);
    drawBoxEdges();
    drawAxes();
    glPopAttrib();
}

/// The balls' soft edges blend with what was drawn before, so that must be what is behind them.
void SphereRenderer::sortFarthestFirst(std::span<const Vec3> positions,
                                       std::span<const float> radii, std::span<const Vec3> colors) {
    balls_.clear();
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (isFinite(positions[i]) && radii[i] > 0.0f)
            balls_.push_back({positions[i], radii[i], colors[i]});
    const Vec3 forward = axesOf(camera).forward;
    std::ranges::stable_sort(balls_, std::ranges::greater{},
                             [&](const Ball& ball) { return dot(ball.position, forward); });
}

/// One vertex buffer: each ball four times, with the four corners of its quad.
void SphereRenderer::uploadQuads() {
    vertices_.clear();
    for (const Ball& ball : balls_)
        for (const Corner corner : {Corner{0, 0}, Corner{1, 0}, Corner{1, 1}, Corner{0, 1}})
            vertices_.push_back({ball, corner});
    glBindBuffer(GL_ARRAY_BUFFER, gl_->vertices);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(Vertex)),
                 vertices_.data(), GL_STREAM_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void SphereRenderer::loadMatrices() {
    const Vec3 center = 0.5f * (world_.lower + world_.upper);
    const float farDistance = length(camera.eye - center) + length(extent(world_));
    view_ = lookAt(camera);
    projection_ = perspective(camera, static_cast<float>(width_) / static_cast<float>(height_),
                              farDistance / 2000.0f, farDistance);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(projection_.data());
    glMatrixMode(GL_MODELVIEW);
    glLoadMatrixf(view_.data());
}

void SphereRenderer::setAttribute(unsigned attribute, int floatCount, std::size_t offset) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribPointer(attribute, floatCount, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                          reinterpret_cast<const void*>(offset));
}

/// One pass over all quads: the balls, or their shadows.
void SphereRenderer::drawQuads(unsigned program) {
    glUseProgram(program);
    const auto width = static_cast<float>(width_), height = static_cast<float>(height_);
    const float tangent = halfHeightTangent(camera);
    glUniform2f(uniform(program, "tangents"), tangent * width / height, tangent);
    glUniform2f(uniform(program, "viewport"), width, height);
    glUniform1f(uniform(program, "floorHeight"), world_.lower.y);
    setVector(program, "up", transformDirection(view_, {0.0f, 1.0f, 0.0f}));
    setVector(program, "keyLight", transformDirection(view_, {-0.36f, 0.80f, 0.48f}));

    glBindBuffer(GL_ARRAY_BUFFER, gl_->vertices);
    setAttribute(0, 4, offsetof(Vertex, ball));  // the radius follows the position
    setAttribute(1, 3, offsetof(Vertex, ball) + offsetof(Ball, color));
    setAttribute(2, 2, offsetof(Vertex, corner));
    glDrawArrays(GL_QUADS, 0, static_cast<GLsizei>(vertices_.size()));
    for (const GLuint attribute : {0u, 1u, 2u}) glDisableVertexAttribArray(attribute);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glUseProgram(0);
}

void SphereRenderer::drawBackground() {
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

void SphereRenderer::drawFloor() {
    const auto [lower, upper] = world_;
    const Vec3 size = extent(world_);
    const float spacing = gridSpacing(std::max(size.x, size.z));
    const float corners[4][2] = {
        {lower.x, lower.z}, {upper.x, lower.z}, {upper.x, upper.z}, {lower.x, upper.z}};
    glUseProgram(gl_->floorProgram);
    glBegin(GL_QUADS);
    for (const auto& [x, z] : corners) {
        glTexCoord2f((x - lower.x) / spacing, (z - lower.z) / spacing);
        glVertex3f(x, lower.y, z);
    }
    glEnd();
    glUseProgram(0);
}

void SphereRenderer::drawBoxEdges() {
    const Vec3 size = extent(world_);
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
}

/// x, y and z in red, green and blue, from the box's lower corner.
void SphereRenderer::drawAxes() {
    const Vec3 size = extent(world_);
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

Frame SphereRenderer::read() {
    const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
    rgba_.resize(4 * width * height);
    glBindFramebuffer(GL_FRAMEBUFFER, gl_->framebuffer);
    // Four bytes a pixel are a plain copy in every driver; three are converted slowly.
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());

    Frame frame{width_, height_, std::vector<std::uint8_t>(3 * width * height)};
    for (std::size_t row = 0; row < height; ++row) {
        // OpenGL's first row is the bottom one.
        const std::uint8_t* from = rgba_.data() + 4 * width * (height - 1 - row);
        std::uint8_t* to = frame.rgb.data() + 3 * width * row;
        for (std::size_t i = 0; i < width; ++i)
            for (std::size_t channel = 0; channel < 3; ++channel)
                to[3 * i + channel] = from[4 * i + channel];
    }
    return frame;
}

}  // namespace ballpit
