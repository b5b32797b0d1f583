// Draws balls into a picture: each is one square on which a shader paints an exact sphere.
#pragma once

#include "common/camera.h"
#include "common/frame.h"

#include <memory>
#include <span>
#include <vector>

namespace ballpit {

struct DrawStyle {
    bool wireframe = false, floorGrid = true;
};

/// Draws offscreen, into a framebuffer object of its own. Needs an OpenGL context that is current
/// as long as the renderer lives. Throws InputError if the driver refuses the frame's size.
class SphereRenderer {
public:
    SphereRenderer(Bounds world, int width, int height);
    ~SphereRenderer();

    /// Draws the world and these balls as `camera` sees them. The three spans have one element a
    /// ball (otherwise std::invalid_argument), colours are in [0, 1]. A ball that is not finite
    /// cannot be drawn and is left out.
    void draw(std::span<const Vec3> positions, std::span<const float> radii,
              std::span<const Vec3> colors);

    /// The picture drawn last.
    Frame read();

    void resize(int width, int height);
    unsigned framebuffer() const;

    Camera camera;
    DrawStyle style;

private:
    struct Ball {
        Vec3 position;
        float radius;
        Vec3 color;
    };
    struct Corner {
        float x, y;
    };
    struct Vertex {
        Ball ball;
        Corner corner;
    };
    struct OpenGLObjects;

    void sortFarthestFirst(std::span<const Vec3> positions, std::span<const float> radii,
                           std::span<const Vec3> colors);
    void loadMatrices();
    void uploadQuads();
    void drawBackground();
    void drawFloor();
    void setAttribute(unsigned attribute, int floatCount, std::size_t offset);
    void drawQuads(unsigned program);
    void drawBoxEdges();
    void drawAxes();

    Bounds world_;
    int width_, height_;
    Matrix4 view_{}, projection_{};
    std::vector<Ball> balls_;
    std::vector<Vertex> vertices_;
    std::vector<unsigned char> rgba_;
    std::unique_ptr<OpenGLObjects> gl_;
};

}  // namespace ballpit
