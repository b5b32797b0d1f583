// freeglut's window, its events, and one picture after the other in it.
#include "10_full_system/opengl_visualizer.h"

#include "common/display_loss.h"
#include "common/error.h"
#include "common/opengl.h"
#include "common/text.h"

#include <GL/glew.h>

#include <GL/freeglut.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>
#include <optional>
#include <thread>
#include <vector>

namespace ballpit {
namespace {

constexpr char escape = 27;
constexpr std::chrono::duration<double> refreshInterval(1.0 / 60.0);

/// freeglut would end the process on an error, and print what it calls a warning. It calls us
/// instead, with nothing of its own on the stack that needs cleaning up, and we do not return.
void failOpening(const char* format, va_list values) {
    std::array<char, 300> words{};
    std::vsnprintf(words.data(), words.size(), format, values);
    throw InputError(std::string("no window can be opened (") + words.data() +
                     "): log in to a desktop, set DISPLAY, or record without a window: --out");
}
void ignoreWarning(const char*, va_list) {}

void initializeOnce() {
    if (glutGet(GLUT_INIT_STATE) == 1) return;
    glutInitErrorFunc(failOpening);
    glutInitWarningFunc(ignoreWarning);
    std::array<char, 8> name{"ballpit"};
    std::array<char*, 2> arguments{name.data(), nullptr};
    int count = 1;
    glutInit(&count, arguments.data());
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE);
    glutSetOption(GLUT_ACTION_ON_WINDOW_CLOSE, GLUT_ACTION_CONTINUE_EXECUTION);
}

struct Key {
    char letter;
    std::string meaning;
    std::function<void()> action;
};

std::string nameOf(char letter) {
    if (letter == ' ') return "Space";
    if (letter == escape) return "Esc";
    return {static_cast<char>(std::toupper(static_cast<unsigned char>(letter)))};
}

}  // namespace

/// All that freeglut's callbacks change. They find it as the window's user data.
struct OpenGLVisualizer::Window {
    Window(Bounds worldBounds, int width, int height, const std::string& title);
    ~Window() { destroy(); }
    Window(const Window&) = delete;

    Camera camera() const;
    void listen();
    void destroy();
    void released();
    void addOwnKeys();
    void draw(std::span<const Vec3> positions, std::span<const float> radii,
              std::span<const Vec3> colors, const std::string& infoText);
    std::string keysText() const;

    void press(char letter);
    void button(int which, bool down, int x, int y);
    void drag(int x, int y);
    void wheel(int direction);
    void resize(int newWidth, int newHeight);

    Bounds world;
    OrbitCamera orbit;
    DrawStyle style;
    bool showsKeys = false, needsRedraw = true, closing = false;
    int width, height;
    std::function<void()> renderFunction;
    std::vector<Key> keys;

    int id = 0;  ///< freeglut's number of the window; 0 once it is gone
    enum class Dragging { nothing, orbit, pan } dragging = Dragging::nothing;
    int lastX = 0, lastY = 0;
    std::optional<SphereRenderer> renderer;
    std::optional<TextPainter> text;
};

OpenGLVisualizer::Window::Window(Bounds worldBounds, int askedWidth, int askedHeight,
                                 const std::string& title)
    : world(worldBounds),
      orbit(orbitOf(frameWorld(world))),
      width(askedWidth),
      height(askedHeight) {
    initializeOnce();
    glutInitWindowSize(width, height);
    id = glutCreateWindow(title.c_str());
    glutSetWindowData(this);
    try {
        if (const std::string missing = loadOpenGL(); !missing.empty())
            throw InputError("a window needs OpenGL 2.1: " + missing +
                             "; install libgl1-mesa-dri or the GPU's driver");
        renderer.emplace(world, width, height);
        text.emplace();
    } catch (...) {
        destroy();
        throw;
    }
    surviveDisplayLoss();
    listen();
    addOwnKeys();
}

namespace {

template <class Window>
Window& current() {
    return *static_cast<Window*>(glutGetWindowData());
}

}  // namespace

void OpenGLVisualizer::Window::listen() {
    glutDisplayFunc([] { current<Window>().needsRedraw = true; });
    glutReshapeFunc([](int w, int h) { current<Window>().resize(w, h); });
    glutKeyboardFunc(
        [](unsigned char key, int, int) { current<Window>().press(static_cast<char>(key)); });
    glutMouseFunc([](int which, int state, int x, int y) {
        current<Window>().button(which, state == GLUT_DOWN, x, y);
    });
    glutMotionFunc([](int x, int y) { current<Window>().drag(x, y); });
    glutMouseWheelFunc([](int, int direction, int, int) { current<Window>().wheel(direction); });
    glutCloseFunc([] { current<Window>().released(); });
}

/// The window and its OpenGL context go now; our objects in it must go first.
void OpenGLVisualizer::Window::released() {
    text.reset();
    renderer.reset();
    id = 0;
}

void OpenGLVisualizer::Window::destroy() {
    if (id == 0) return;
    glutSetWindow(id);
    glutCloseFunc(nullptr);
    const int destroyed = id;
    released();
    glutDestroyWindow(destroyed);
    glutMainLoopEvent();  // only there does freeglut really destroy it
}

/// In a window narrower than 16:9 the view is as wide as in that, and higher.
Camera OpenGLVisualizer::Window::camera() const {
    Camera camera = orbit.camera();
    const float missing = 16.0f / 9.0f * static_cast<float>(height) / static_cast<float>(width);
    constexpr float degrees = 360.0f / std::numbers::pi_v<float>;  // of a half angle, twice
    if (missing > 1.0f)
        camera.verticalFieldOfView = degrees * std::atan(halfHeightTangent(camera) * missing);
    return camera;
}

// ---- Mouse and keys

void OpenGLVisualizer::Window::addOwnKeys() {
    keys = {{'w', "wireframe on or off", [this] { style.wireframe = !style.wireframe; }},
            {'g', "floor grid on or off", [this] { style.floorGrid = !style.floorGrid; }},
            {'r', "camera as at first", [this] { orbit = orbitOf(frameWorld(world)); }},
            {'h', "these keys", [this] { showsKeys = !showsKeys; }},
            {escape, "quit", [this] { closing = true; }}};
}

void OpenGLVisualizer::Window::press(char letter) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    for (const Key& key : keys)
        if (key.letter == letter) key.action();
    needsRedraw = true;
}

void OpenGLVisualizer::Window::button(int which, bool down, int x, int y) {
    const bool shift = glutGetModifiers() & GLUT_ACTIVE_SHIFT;
    dragging = Dragging::nothing;
    if (down && which == GLUT_LEFT_BUTTON) dragging = shift ? Dragging::pan : Dragging::orbit;
    if (down && which == GLUT_MIDDLE_BUTTON) dragging = Dragging::pan;
    lastX = x;
    lastY = y;
}

void OpenGLVisualizer::Window::drag(int x, int y) {
    // In frame heights: half a turn takes a drag from the window's top to its bottom.
    const float right = static_cast<float>(x - lastX) / static_cast<float>(height);
    const float down = static_cast<float>(y - lastY) / static_cast<float>(height);
    lastX = x;
    lastY = y;
    constexpr float halfTurn = 180.0f;  // degrees
    if (dragging == Dragging::orbit) orbit.orbit(-halfTurn * right, halfTurn * down);
    if (dragging == Dragging::pan) {
        // What lies at the target's depth follows the mouse.
        const float metres = 2.0f * halfHeightTangent(camera()) * orbit.distance;
        orbit.pan(-metres * right, metres * down);
    }
    needsRedraw = true;
}

void OpenGLVisualizer::Window::wheel(int direction) {
    orbit.zoom(direction > 0 ? 1 / 1.1f : 1.1f);
    needsRedraw = true;
}

void OpenGLVisualizer::Window::resize(int newWidth, int newHeight) {
    width = std::max(1, newWidth);
    height = std::max(1, newHeight);
    needsRedraw = true;
}

// ---- The picture

std::string OpenGLVisualizer::Window::keysText() const {
    std::string lines =
        "left drag    orbit\n"
        "wheel        zoom\n"
        "middle drag  pan (or Shift and left drag)\n\n";
    for (const Key& key : keys) {
        std::string name = nameOf(key.letter);
        name.resize(13, ' ');
        lines += name + key.meaning + '\n';
    }
    return lines;
}

void OpenGLVisualizer::Window::draw(std::span<const Vec3> positions, std::span<const float> radii,
                                    std::span<const Vec3> colors, const std::string& infoText) {
    glutSetWindow(id);
    if (renderer->width() != width || renderer->height() != height) renderer->resize(width, height);
    renderer->camera = camera();
    renderer->style = style;
    renderer->draw(positions, radii, colors);
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->framebuffer());
    text->draw(infoText, TextPainter::Place::topLeft, width, height);
    if (showsKeys) text->draw(keysText(), TextPainter::Place::center, width, height);

    glBindFramebuffer(GL_READ_FRAMEBUFFER, renderer->framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glutSwapBuffers();
    needsRedraw = false;
}

OpenGLVisualizer::OpenGLVisualizer(Bounds worldBounds, int width, int height,
                                   const std::string& title)
    : window_(std::make_unique<Window>(worldBounds, width, height, title)) {}

OpenGLVisualizer::~OpenGLVisualizer() = default;

void OpenGLVisualizer::render(std::span<const Vec3> positions, std::span<const float> radii,
                              std::span<const Vec3> colors, const std::string& infoText) {
    if (isOpen()) window_->draw(positions, radii, colors, infoText);
}

void OpenGLVisualizer::setRenderFunction(std::function<void()> function) {
    window_->renderFunction = std::move(function);
}

void OpenGLVisualizer::addKey(char key, const std::string& meaning, std::function<void()> action) {
    window_->keys.insert(window_->keys.begin(), {key, meaning, std::move(action)});
}

/// freeglut's own main loop sleeps between events; ours also has pictures to show.
void OpenGLVisualizer::run() {
    while (isOpen()) {
        const auto start = std::chrono::steady_clock::now();
        glutMainLoopEvent();
        if (!isOpen()) break;
        if (window_->renderFunction) window_->renderFunction();
        std::this_thread::sleep_until(start + refreshInterval);
    }
    window_->destroy();
}

void OpenGLVisualizer::close() { window_->closing = true; }
bool OpenGLVisualizer::isOpen() const {
    return window_->id != 0 && !window_->closing && !displayLost();
}
bool OpenGLVisualizer::needsRedraw() const { return window_->needsRedraw; }
Camera OpenGLVisualizer::camera() const { return window_->camera(); }
const OrbitCamera& OpenGLVisualizer::orbit() const { return window_->orbit; }
DrawStyle OpenGLVisualizer::style() const { return window_->style; }
bool OpenGLVisualizer::showsKeys() const { return window_->showsKeys; }
int OpenGLVisualizer::width() const { return window_->width; }
int OpenGLVisualizer::height() const { return window_->height; }

}  // namespace ballpit
