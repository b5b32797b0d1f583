// The ways in which a crowd of balls is drawn. Each holds what it needs of OpenGL.
#pragma once

#include <map>
#include <vector>

#include "08_sphere_rendering/sight.h"
#include "08_sphere_rendering/sphere.h"

namespace ballpit {

/// Impostors: a square for each ball, on which a shader paints an exact sphere.
class BallQuads {
public:
    BallQuads();

    /// Takes the balls of a picture, sorted from far to near if their edges are to be soft: these
    /// blend with what was drawn before, so that must be what is behind them.
    void take(const Balls& balls, const Sight& sight, bool softEdges);

    void draw(const Sight& sight) const;
    /// Draws the squares with the program in use, which places them.
    void drawSquares() const;

private:
    struct Ball {
        Vec3 position;
        float radius;
        Vec3 color;
    };
    struct Vertex {
        Ball ball;
        float cornerX, cornerY;
    };

    OpenGLProgram program_;
    OpenGLBuffer vertices_;
    std::vector<Ball> balls_;
    std::vector<Vertex> corners_;
    bool softEdges_ = true;
};

/// Impostors for very many balls: a point each, 16 bytes that may come from anywhere, and a colour
/// that is uploaded only when it changes. No order, so hard edges.
class BallPoints {
public:
    BallPoints();

    /// Takes the balls of a picture; leaves out those too large for a point and returns them.
    std::vector<std::size_t> take(const Balls& balls, const Sight& sight);

    /// Takes what lies in the open buffer. std::invalid_argument without a colour for each ball.
    void takeOpenBuffer();

    /// The open buffer, which others fill: room for `count` balls; its OpenGL name. Only another
    /// count gives it other memory.
    GLuint reserve(std::size_t count);
    void setColors(std::span<const Vec3> colors);

    /// What is in the open buffer, fetched from the graphics card.
    std::vector<Vec4> fetch() const;
    const std::vector<Vec3>& colors() const { return open_.colors; }

    /// Is a ball of this radius in pixels too large for the driver's points?
    bool isTooLarge(float pixelRadius) const;

    void draw(const Sight& sight) const;
    /// Draws at most `most` of the points, spread evenly over the buffer, with the program in use.
    void drawSquares(std::size_t most) const;

private:
    struct Store {
        OpenGLBuffer positionBuffer, colorBuffer;
        std::size_t count = 0;
        std::vector<Vec3> colors;  // what is in the colour buffer

        void setColors(std::span<const Vec3> newColors);
    };

    std::vector<std::size_t> takeOutTooLarge(const Sight& sight);

    OpenGLProgram program_;
    Store own_, open_;
    const Store* taken_ = &own_;
    std::vector<Vec4> packed_;
    float largestPoint_ = 1.0f;  // pixels across
};

/// GLU spheres, each as finely divided as its size on the screen needs.
class BallMeshes {
public:
    BallMeshes();

    /// `slices` for all, or 0: chosen by size.
    void draw(const Balls& balls, const Sight& sight, int slices, bool wireframe);

private:
    const Sphere& sphereOf(int slices);

    OpenGLProgram program_;
    std::map<int, Sphere> spheres_;  // by slices
};

}  // namespace ballpit
