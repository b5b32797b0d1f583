// Draws flat pictures without a graphics card: the same pixels on every machine.
#pragma once

#include <functional>

#include "common/frame.h"
#include "common/vec3.cuh"

namespace ballpit::check {

namespace colors {
constexpr Vec3 paper{1.0f, 1.0f, 1.0f}, grey{0.72f, 0.72f, 0.74f}, ink{0.18f, 0.19f, 0.22f};
constexpr Vec3 red{0.86f, 0.15f, 0.13f}, blue{0.20f, 0.45f, 0.80f}, line{0.85f, 0.85f, 0.87f};
}  // namespace colors

class Canvas {
public:
    Canvas(int width, int height);

    /// Pixels, x to the right, y down. Colours are in [0, 1]. What lies outside is not drawn.
    void disc(float x, float y, float radius, Vec3 color);
    void ring(float x, float y, float radius, float thickness, Vec3 color);
    void line(float x0, float y0, float x1, float y1, float thickness, Vec3 color);
    void rectangle(float x0, float y0, float x1, float y1, Vec3 color);

    const Frame& frame() const { return frame_; }

private:
    void blend(int x, int y, Vec3 color, float coverage);
    void fill(float x0, float y0, float x1, float y1, Vec3 color,
              const std::function<float(float, float)>& coverage);

    Frame frame_;
};

/// Maps world coordinates of a rectangle (m) to the pixels of one panel.
struct Panel {
    float left, top, scale, worldLeft, worldTop;
    float x(float worldX) const { return left + scale * (worldX - worldLeft); }
    float y(float worldY) const { return top + scale * (worldTop - worldY); }
};

/// An arrow in the plane of x and y; `along` and the length of its head in m. What is too short to
/// be seen, or endless, is not drawn.
void arrow(Canvas& canvas, const Panel& panel, Vec3 from, Vec3 along, float head, Vec3 color);

/// Three panels of `size` pixels side by side for one square region of the world (lower corner,
/// side in m): yours, reference, errors. `draw(canvas, panel, k)` draws panel k.
Frame threePanels(float worldX, float worldY, float side, int size,
                  const std::function<void(Canvas&, const Panel&, int)>& draw);

}  // namespace ballpit::check
