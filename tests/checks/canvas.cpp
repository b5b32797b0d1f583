// Anti-aliased shapes: a pixel's colour is mixed by how far its centre is inside the shape.
#include "tests/checks/canvas.h"

#include <algorithm>
#include <cmath>

namespace ballpit::check {

Canvas::Canvas(int width, int height) {
    frame_.width = width;
    frame_.height = height;
    frame_.rgb.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255);
}

void Canvas::blend(int x, int y, Vec3 color, float coverage) {
    if (coverage <= 0.0f) return;
    const float share = std::min(coverage, 1.0f);
    const std::size_t pixel =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width) +
             static_cast<std::size_t>(x));
    const float channels[] = {color.x, color.y, color.z};
    for (std::size_t c = 0; c < 3; ++c) {
        const float before = frame_.rgb[pixel + c];
        const float mixed = before + share * (255.0f * channels[c] - before);
        frame_.rgb[pixel + c] = static_cast<std::uint8_t>(std::lround(mixed));
    }
}

void Canvas::fill(float x0, float y0, float x1, float y1, Vec3 color,
                  const std::function<float(float, float)>& coverage) {
    const auto inside = [](float value, int size) {
        return static_cast<int>(std::clamp(value, 0.0f, static_cast<float>(size)));
    };
    for (int y = inside(y0 - 1, frame_.height); y < inside(y1 + 2, frame_.height); ++y)
        for (int x = inside(x0 - 1, frame_.width); x < inside(x1 + 2, frame_.width); ++x)
            blend(x, y, color,
                  coverage(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
}

void Canvas::disc(float x, float y, float radius, Vec3 color) {
    fill(x - radius, y - radius, x + radius, y + radius, color, [&](float px, float py) {
        return radius + 0.5f - std::sqrt((px - x) * (px - x) + (py - y) * (py - y));
    });
}

void Canvas::ring(float x, float y, float radius, float thickness, Vec3 color) {
    const float outer = radius + thickness / 2;
    fill(x - outer, y - outer, x + outer, y + outer, color, [&](float px, float py) {
        const float distance = std::sqrt((px - x) * (px - x) + (py - y) * (py - y));
        return thickness / 2 + 0.5f - std::abs(distance - radius);
    });
}

void Canvas::line(float x0, float y0, float x1, float y1, float thickness, Vec3 color) {
    const float dx = x1 - x0, dy = y1 - y0, squared = dx * dx + dy * dy;
    const float margin = thickness / 2;
    fill(std::min(x0, x1) - margin, std::min(y0, y1) - margin, std::max(x0, x1) + margin,
         std::max(y0, y1) + margin, color, [&](float px, float py) {
             const float along =
                 squared > 0 ? std::clamp(((px - x0) * dx + (py - y0) * dy) / squared, 0.0f, 1.0f)
                             : 0.0f;
             const float ex = px - x0 - along * dx, ey = py - y0 - along * dy;
             return margin + 0.5f - std::sqrt(ex * ex + ey * ey);
         });
}

void Canvas::rectangle(float x0, float y0, float x1, float y1, Vec3 color) {
    fill(x0, y0, x1, y1, color, [&](float px, float py) {
        return std::min({px - x0, x1 - px, py - y0, y1 - py}) + 0.5f;
    });
}

void arrow(Canvas& canvas, const Panel& panel, Vec3 from, Vec3 along, float head, Vec3 color) {
    const Vec3 tip = from + along;
    const float size = length(along);
    if (!(size > 0.02f && size < 100.0f)) return;
    const Vec3 back = (-head / size) * along, side{0.5f * back.y, -0.5f * back.x, 0};
    for (const Vec3 start : {from, tip + back + side, tip + back - side})
        canvas.line(panel.x(start.x), panel.y(start.y), panel.x(tip.x), panel.y(tip.y), 3.0f,
                    color);
}

Frame threePanels(float worldX, float worldY, float side, int size,
                  const std::function<void(Canvas&, const Panel&, int)>& draw) {
    constexpr int gap = 12;
    Canvas canvas(3 * size + 4 * gap, size + 2 * gap);
    for (int k = 0; k < 3; ++k) {
        const auto left = static_cast<float>(gap + k * (size + gap)), top = float(gap);
        const auto length = static_cast<float>(size);
        const Panel panel{left, top, length / side, worldX, worldY + side};
        draw(canvas, panel, k);
        for (const float edge : {0.0f, length}) {
            canvas.line(left, top + edge, left + length, top + edge, 1.0f, colors::ink);
            canvas.line(left + edge, top, left + edge, top + length, 1.0f, colors::ink);
        }
    }
    return canvas.frame();
}

}  // namespace ballpit::check
