// An OpenGL context without a window or a display: the normal case here.
#pragma once

#include <string>

namespace ballpit {

/// While it lives, OpenGL (2.1 or later, compatibility profile, with framebuffer objects) can be
/// used on the thread that made it, GLEW's functions included. There is no default framebuffer to
/// draw to: draw into a framebuffer object. Throws InputError if no driver offers that.
class OffscreenContext {
public:
    OffscreenContext();
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    /// Makes its OpenGL current again, on a thread that uses several contexts in turn.
    void makeCurrent();

    /// The renderer and its version, as the driver names them.
    std::string description() const;

private:
    bool tryDisplay(void* display);
    bool makeContext(void* config);
    void destroy();

    // EGLDisplay, EGLSurface and EGLContext are void*; so users of this header need no EGL.
    void* display_ = nullptr;
    void* surface_ = nullptr;
    void* context_ = nullptr;
    std::string lastFailure_ = "no EGL display found";
};

}  // namespace ballpit
