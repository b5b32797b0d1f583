// Draws balls into a picture: as nets of faces, as exact spheres on squares, or as points.
#pragma once

#include "common/camera.h"
#include "common/frame.h"

#include <memory>
#include <span>
#include <vector>

namespace ballpit {

/// What a ball is made of. Chapter 08 explains and measures all of them.
enum class BallShape {
    automatic,   ///< impostors; points when they are many
    impostors,   ///< a square each, sorted, with soft edges
    points,      ///< a point each, unsorted, with hard edges; what is too large for one, a square
    gluSpheres,  ///< nets of faces
};

struct DrawStyle {
    bool wireframe = false;  ///< only the edges of the nets, whatever the shape
    bool floorGrid = true;   ///< lines on the floor
    bool world = true;       ///< background, floor, shadows, edges and axes; else balls on black
    BallShape shape = BallShape::automatic;
    int slices = 0;  ///< of GLU spheres, with half as many stacks; 0: as many as their size needs
};

struct Balls;

/// Draws offscreen, into a framebuffer object of its own. Needs an OpenGL context that is current
/// as long as the renderer lives. Throws InputError if the driver refuses the frame's size.
class SphereRenderer {
public:
    SphereRenderer(Bounds world, int width, int height);
    ~SphereRenderer();

    /// Frames of another size from now on; what was drawn is lost. InputError as above: then all
    /// stays as it was.
    void resize(int width, int height);

    /// Draws the world and these balls as `camera` sees them. The three spans have one element a
    /// ball (otherwise std::invalid_argument), colours are in [0, 1]. A ball that is not finite
    /// cannot be drawn and is left out.
    void draw(std::span<const Vec3> positions, std::span<const float> radii,
              std::span<const Vec3> colors);

    /// True if so many balls are drawn as points, so that drawFromBuffer gives draw's picture.
    bool drawsPoints(std::size_t count) const { return shapeFor(count) == BallShape::points; }

    /// For balls that are on the graphics card already: the OpenGL name of a buffer with room for
    /// `count` balls, four floats each: x, y, z and radius in m. Fill it (glBufferSubData, or a
    /// CUDA kernel), then call drawFromBuffer. The renderer only reads it. It keeps its memory as
    /// long as the count stays the same.
    unsigned positionBuffer(std::size_t count);

    /// The colours of the balls in that buffer. Uploaded only when they have changed.
    void setColors(std::span<const Vec3> colors);

    /// Draws the balls in the buffer as points. No ball may be larger than `largestRadius`: if the
    /// driver's points are too small for it, the balls are fetched first, which is slow.
    void drawFromBuffer(float largestRadius);

    /// The picture drawn last.
    Frame read();

    /// Waits until it is drawn: OpenGL draws while the program goes on.
    void finish();

    /// OpenGL's name of the framebuffer object that holds it, to read or to copy from.
    unsigned framebuffer() const;

    int width() const { return width_; }
    int height() const { return height_; }

    Camera camera;
    DrawStyle style;

private:
    struct Parts;

    BallShape shapeFor(std::size_t count) const;
    void beginFrame();
    void endFrame();
    void drawAsPoints(const Balls& balls);
    void drawPoints();

    Bounds world_;
    int width_ = 0, height_ = 0;
    std::vector<unsigned char> rgba_;
    std::unique_ptr<Parts> parts_;
};

}  // namespace ballpit
