// Finds a driver through EGL and makes its OpenGL current without a surface.
#include "common/offscreen_context.h"

#include "common/error.h"
#include "common/opengl.h"

#include <GL/glew.h>
#define EGL_NO_X11  // else eglplatform.h pulls in Xlib and its macros
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace ballpit {
namespace {

bool hasExtension(EGLDisplay display, const char* name) {
    const char* all = eglQueryString(display, EGL_EXTENSIONS);
    return all && std::strstr(all, name);
}

template <class Function>
Function load(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// Displays worth trying, best first: GPUs that have no display attached, Mesa's software
/// renderer, whatever the system calls its default.
std::vector<EGLDisplay> candidateDisplays() {
    std::vector<EGLDisplay> displays;
    const auto getPlatformDisplay =
        load<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    const auto queryDevices = load<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (getPlatformDisplay && queryDevices && hasExtension(nullptr, "EGL_EXT_platform_device"))
        queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        displays.push_back(getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    if (getPlatformDisplay && hasExtension(nullptr, "EGL_MESA_platform_surfaceless"))
        displays.push_back(getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
    displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return displays;
}

EGLConfig chooseConfig(EGLDisplay display) {
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display, wanted, &config, 1, &count);
    return count > 0 ? config : nullptr;
}

}  // namespace

OffscreenContext::OffscreenContext() {
    setenv("EGL_LOG_LEVEL", "fatal", 0);  // Mesa warns on stderr of each device it may not open
    for (EGLDisplay display : candidateDisplays())
        if (display != EGL_NO_DISPLAY && tryDisplay(display)) return;
    throw InputError("No OpenGL: cannot draw without a display (" + lastFailure_ +
                     "); likely no driver is installed. Install libgl1-mesa-dri (software "
                     "rendering) or the GPU's driver with its EGL library");
}

OffscreenContext::~OffscreenContext() { destroy(); }

bool OffscreenContext::tryDisplay(void* display) {
    display_ = display;
    if (!eglInitialize(display_, nullptr, nullptr)) {
        lastFailure_ = "an EGL display failed to initialize";
        return false;
    }
    const EGLConfig config = chooseConfig(display_);
    if (!config || !eglBindAPI(EGL_OPENGL_API)) {
        lastFailure_ = "the EGL display offers no OpenGL";
        return false;
    }
    if (makeContext(config)) {
        const std::string missing = loadOpenGL();
        if (missing.empty()) return true;
        lastFailure_ = missing;
    }
    destroy();
    return false;
}

bool OffscreenContext::makeContext(void* config) {
    // Asking for no version gives the newest compatibility profile.
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, nullptr);
    lastFailure_ = "EGL made no OpenGL context";
    if (context_ == EGL_NO_CONTEXT) return false;
    if (!hasExtension(display_, "EGL_KHR_surfaceless_context")) {
        const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface_ = eglCreatePbufferSurface(display_, config, size);
    }
    lastFailure_ = "EGL could not make the OpenGL context current";
    return eglMakeCurrent(display_, surface_, surface_, context_);
}

/// The display stays initialized: EGL shares it between all contexts of the process.
void OffscreenContext::destroy() {
    if (context_ == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context_)
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    eglDestroyContext(display_, context_);
    surface_ = context_ = nullptr;
}

void OffscreenContext::makeCurrent() {
    if (eglGetCurrentContext() != context_) eglMakeCurrent(display_, surface_, surface_, context_);
}

std::string OffscreenContext::description() const {
    const auto text = [](GLenum name) {
        return std::string(reinterpret_cast<const char*>(glGetString(name)));
    };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace ballpit
