// GLEW's functions. Its flags describe the context that loaded them first, so versions are asked
// from the context itself.
#include "common/opengl.h"

#include <GL/glew.h>

#include <cstdlib>
#include <cstring>
#include <mutex>

namespace ballpit {
namespace {

const char* text(GLenum name) {
    const GLubyte* words = glGetString(name);
    return words ? reinterpret_cast<const char*>(words) : "";
}

/// Empty, or why the functions could not be loaded. A window's thread and a recording's may both
/// come here, and GLEW writes global variables.
std::string loadOnce() {
    static std::mutex mutex;
    static bool loaded = false;
    const std::lock_guard lock(mutex);
    if (loaded) return {};
    const GLenum result = glewInit();
    loaded = true;
    // Without an X display GLEW stops after loading OpenGL, before GLX, which nobody needs here.
    if (result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY) return {};
    loaded = false;
    return std::string("GLEW: ") + reinterpret_cast<const char*>(glewGetErrorString(result));
}

}  // namespace

std::string loadOpenGL() {
    if (const std::string failure = loadOnce(); !failure.empty()) return failure;
    const std::string version = text(GL_VERSION);
    const double number = std::strtod(version.c_str(), nullptr);
    if (number < 2.1)
        return "the driver's OpenGL is " + version.substr(0, version.find(' ')) +
               ", and 2.1 is needed";
    if (number < 3.0 && !std::strstr(text(GL_EXTENSIONS), "GL_ARB_framebuffer_object"))
        return "the driver has no framebuffer objects";
    return {};
}

}  // namespace ballpit
