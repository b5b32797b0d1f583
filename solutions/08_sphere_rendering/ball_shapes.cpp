// Squares, points and nets: what is uploaded, and the calls that draw it.
#include "08_sphere_rendering/ball_shapes.h"

#include "08_sphere_rendering/ball_shaders.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace ballpit {
namespace {

void disableAttributes() {
    for (const GLuint attribute : {0u, 1u, 2u}) glDisableVertexAttribArray(attribute);
}

/// Coarser steps of 4 slices: fewer display lists, and never too few slices.
int rounded(int slices) { return slices + (4 - slices % 4) % 4; }

}  // namespace

// ---- squares

BallQuads::BallQuads() : program_(quadVertexShader(), impostorFragmentShader()) {}

void BallQuads::take(const Balls& balls, const Sight& sight, bool softEdges) {
    softEdges_ = softEdges;
    balls_.clear();
    for (std::size_t i = 0; i < balls.count(); ++i)
        if (balls.canBeDrawn(i))
            balls_.push_back({balls.positions[i], balls.radii[i], balls.colors[i]});
    const Vec3 forward = axesOf(sight.camera).forward;
    if (softEdges)
        std::ranges::stable_sort(balls_, std::ranges::greater{},
                                 [&](const Ball& ball) { return dot(ball.position, forward); });
    corners_.clear();
    for (const Ball& ball : balls_) {
        corners_.push_back({ball, 0, 0});
        corners_.push_back({ball, 1, 0});
        corners_.push_back({ball, 1, 1});
        corners_.push_back({ball, 0, 1});
    }
    vertices_.fill(corners_.data(), corners_.size() * sizeof(Vertex), GL_STREAM_DRAW);
}

void BallQuads::draw(const Sight& sight) const {
    program_.use();
    sight.tell(program_);
    program_.set("hardEdges", softEdges_ ? 0.0f : 1.0f);
    drawSquares();
    glUseProgram(0);
}

void BallQuads::drawSquares() const {
    vertices_.attribute(0, 4, offsetof(Vertex, ball), sizeof(Vertex));  // the radius follows
    vertices_.attribute(1, 3, offsetof(Vertex, ball) + offsetof(Ball, color), sizeof(Vertex));
    vertices_.attribute(2, 2, offsetof(Vertex, cornerX), sizeof(Vertex));
    glDrawArrays(GL_QUADS, 0, static_cast<GLsizei>(corners_.size()));
    disableAttributes();
}

// ---- points

BallPoints::BallPoints() : program_(pointVertexShader(), impostorFragmentShader()) {
    GLfloat range[2] = {1.0f, 1.0f};
    glGetFloatv(GL_ALIASED_POINT_SIZE_RANGE, range);
    largestPoint_ = range[1];
}

bool BallPoints::isTooLarge(float pixelRadius) const {
    // Perspective stretches a ball towards the frame's corners: 1.4 times leaves room for that.
    return 1.4f * 2.0f * pixelRadius > largestPoint_;
}

std::vector<std::size_t> BallPoints::take(const Balls& balls, const Sight& sight) {
    const Vec3 forward = axesOf(sight.camera).forward;
    float nearest = std::numeric_limits<float>::infinity(), largest = 0.0f;  // depth, radius
    packed_.assign(balls.count(), Vec4{});                                   // radius 0: not drawn
    for (std::size_t i = 0; i < balls.count(); ++i) {
        if (!balls.canBeDrawn(i)) continue;
        packed_[i] = withW(balls.positions[i], balls.radii[i]);
        nearest = std::min(nearest, dot(balls.positions[i] - sight.camera.eye, forward));
        largest = std::max(largest, balls.radii[i]);
    }
    // Only if the largest ball at the nearest place would be too large must each be asked.
    const Vec3 nearestPlace = sight.camera.eye + nearest * forward;
    std::vector<std::size_t> large;
    if (largest > 0.0f && isTooLarge(sight.pixelRadius(nearestPlace, largest)))
        large = takeOutTooLarge(sight);
    own_.count = balls.count();
    own_.positionBuffer.fill(packed_.data(), packed_.size() * sizeof(Vec4), GL_STREAM_DRAW);
    own_.setColors(balls.colors);
    taken_ = &own_;
    return large;
}

std::vector<std::size_t> BallPoints::takeOutTooLarge(const Sight& sight) {
    std::vector<std::size_t> large;
    for (std::size_t i = 0; i < packed_.size(); ++i) {
        if (packed_[i].w <= 0.0f) continue;
        if (!isTooLarge(sight.pixelRadius(xyz(packed_[i]), packed_[i].w))) continue;
        large.push_back(i);
        packed_[i] = {};
    }
    return large;
}

void BallPoints::takeOpenBuffer() {
    if (open_.colors.size() != open_.count)
        throw std::invalid_argument("setColors: one colour for each ball in the buffer is needed");
    taken_ = &open_;
}

GLuint BallPoints::reserve(std::size_t count) {
    if (count != open_.count)
        open_.positionBuffer.fill(nullptr, count * sizeof(Vec4), GL_DYNAMIC_DRAW);
    open_.count = count;
    return open_.positionBuffer.name();
}

void BallPoints::setColors(std::span<const Vec3> colors) { open_.setColors(colors); }

void BallPoints::Store::setColors(std::span<const Vec3> newColors) {
    if (std::ranges::equal(newColors, colors)) return;
    colors.assign(newColors.begin(), newColors.end());
    colorBuffer.fill(colors.data(), colors.size() * sizeof(Vec3), GL_STATIC_DRAW);
}

std::vector<Vec4> BallPoints::fetch() const {
    std::vector<Vec4> balls(open_.count);
    open_.positionBuffer.bind();
    glGetBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(balls.size() * sizeof(Vec4)),
                       balls.data());
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    return balls;
}

void BallPoints::draw(const Sight& sight) const {
    program_.use();
    sight.tell(program_);
    program_.set("hardEdges", 1.0f);
    drawSquares(taken_->count);
    glUseProgram(0);
}

void BallPoints::drawSquares(std::size_t most) const {
    if (taken_->count == 0) return;
    const std::size_t every = (taken_->count + most - 1) / most;
    glEnable(GL_VERTEX_PROGRAM_POINT_SIZE);
    glEnable(GL_POINT_SPRITE);
    taken_->positionBuffer.attribute(0, 4, 0, every * sizeof(Vec4));
    taken_->colorBuffer.attribute(1, 3, 0, every * sizeof(Vec3));
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(taken_->count / every));
    disableAttributes();
    glDisable(GL_POINT_SPRITE);
    glDisable(GL_VERTEX_PROGRAM_POINT_SIZE);
}

// ---- nets

BallMeshes::BallMeshes() : program_(meshVertexShader, meshFragmentShader()) {}

const Sphere& BallMeshes::sphereOf(int slices) {
    return spheres_.try_emplace(slices, slices, std::max(slices / 2, 2)).first->second;
}

void BallMeshes::draw(const Balls& balls, const Sight& sight, int slices, bool wireframe) {
    program_.use();
    sight.tell(program_);
    if (wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    for (std::size_t i = 0; i < balls.count(); ++i) {
        if (!balls.canBeDrawn(i)) continue;
        const float pixels = sight.pixelRadius(balls.positions[i], balls.radii[i]);
        const Sphere& sphere = sphereOf(slices > 0 ? slices : rounded(slicesFor(pixels)));
        drawBall(sphere, balls.positions[i], balls.radii[i], balls.colors[i]);
    }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glUseProgram(0);
}

}  // namespace ballpit
