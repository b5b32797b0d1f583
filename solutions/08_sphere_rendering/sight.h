// What every pass of a picture must know about the eye.
#pragma once

#include "08_sphere_rendering/detail.h"
#include "08_sphere_rendering/opengl_program.h"
#include "08_sphere_rendering/view_matrices.h"

#include <cmath>
#include <span>

namespace ballpit {

/// A camera with its matrices, for frames of one size.
struct Sight {
    Camera camera;
    int width, height;
    Matrix4 view, projection;

    Sight(const Camera& camera, Bounds world, int width, int height)
        : camera(camera), width(width), height(height), view(lookAt(camera)) {
        const Vec3 center = 0.5f * (world.lower + world.upper);
        const float farDistance = length(camera.eye - center) + length(extent(world));
        projection = perspective(camera, static_cast<float>(width) / static_cast<float>(height),
                                 farDistance / 2000.0f, farDistance);
    }

    /// How large a ball appears in these frames.
    float pixelRadius(Vec3 position, float radius) const {
        return ballpit::pixelRadius(camera, height, position, radius);
    }

    void loadMatrices() const {
        glMatrixMode(GL_PROJECTION);
        glLoadMatrixf(projection.data());
        glMatrixMode(GL_MODELVIEW);
        glLoadMatrixf(view.data());
    }

    /// What the shaders of balls ask for, given to the program in use.
    void tell(const OpenGLProgram& program) const {
        const auto w = static_cast<float>(width), h = static_cast<float>(height);
        const float tangent = halfHeightTangent(camera);
        program.set("tangents", tangent * w / h, tangent);
        program.set("viewport", w, h);
        program.set("up", transformDirection(view, {0.0f, 1.0f, 0.0f}));
        program.set("keyLight", transformDirection(view, {-0.36f, 0.80f, 0.48f}));
    }
};

/// The balls of one picture: three arrays with an element a ball.
struct Balls {
    std::span<const Vec3> positions;
    std::span<const float> radii;
    std::span<const Vec3> colors;

    std::size_t count() const { return positions.size(); }
    /// NaN and infinity cannot be drawn.
    bool canBeDrawn(std::size_t i) const {
        return isFinite(positions[i]) && radii[i] > 0.0f && std::isfinite(radii[i]);
    }
};

}  // namespace ballpit
