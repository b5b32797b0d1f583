// The window: draws balls in it, and lets mouse and keys move the camera.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "08_sphere_rendering/orbit_camera.h"
#include "08_sphere_rendering/sphere_renderer.h"

namespace ballpit {

/// A window with a world of balls. Left-drag orbits, the wheel zooms, middle-drag (or Shift and
/// left-drag) pans; W wireframe, G floor grid, R camera as at first, H this list, Esc the end. All
/// of it on one thread. InputError if there is no display, or its OpenGL cannot draw.
class OpenGLVisualizer {
public:
    explicit OpenGLVisualizer(Bounds worldBounds, int width = 1920, int height = 1080,
                              const std::string& title = "Ballpit");
    ~OpenGLVisualizer();
    OpenGLVisualizer(const OpenGLVisualizer&) = delete;

    /// Draws the balls, over them the lines of `infoText`, and shows that in the window. The spans
    /// as for SphereRenderer::draw.
    void render(std::span<const Vec3> positions, std::span<const float> radii,
                std::span<const Vec3> colors, const std::string& infoText = {});

    /// What run() calls sixty times a second; it calls render() if there is something new.
    void setRenderFunction(std::function<void()> function);

    /// One more key, capital or not, and what the list of keys says of it.
    void addKey(char key, const std::string& meaning, std::function<void()> action);

    /// Serves the window; blocks until it is closed: by Esc, its button or close().
    void run();
    void close();
    bool isOpen() const;

    /// True if the window's contents are out of date though the balls are not: the camera or the
    /// style changed, the window was resized or uncovered.
    bool needsRedraw() const;

    Camera camera() const;
    const OrbitCamera& orbit() const;
    DrawStyle style() const;
    bool showsKeys() const;
    int width() const;  ///< pixels
    int height() const;

private:
    struct Window;
    std::unique_ptr<Window> window_;
};

}  // namespace ballpit
