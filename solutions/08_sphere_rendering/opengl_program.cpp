// Compiles and links shaders, and says which line a driver refuses.
#include "08_sphere_rendering/opengl_program.h"

#include <array>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace ballpit {
namespace {

/// The line that a message like "0:12(5): error" (Mesa) or "0(12) : error" (NVIDIA) is about.
std::string lineNamed(const std::string& message, const std::string& source) {
    int number = 0;
    if (std::sscanf(message.c_str(), "0%*1[:(]%d", &number) != 1) return "";
    std::istringstream lines(source);
    std::string line;
    for (; number > 0; --number)
        if (!std::getline(lines, line)) return "";
    return "; the line is: " + line;
}

[[noreturn]] void refuse(std::string message, const std::string& source) {
    const std::string line = lineNamed(message, source);
    while (!message.empty() && message.back() == '\n') message.pop_back();
    throw std::runtime_error("the driver refused a shader: " + message + line);
}

GLuint compileShader(GLenum kind, const std::string& source) {
    const GLuint shader = glCreateShader(kind);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) return shader;
    std::array<char, 1024> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    glDeleteShader(shader);
    refuse(log.data(), source);
}

}  // namespace

OpenGLProgram::OpenGLProgram(const std::string& vertexSource, const std::string& fragmentSource) {
    const GLuint vertexShader = compileShader(GL_VERTEX_SHADER, vertexSource);
    const GLuint fragmentShader = compileShader(GL_FRAGMENT_SHADER, fragmentSource);
    name_ = glCreateProgram();
    glAttachShader(name_, vertexShader);
    glAttachShader(name_, fragmentShader);
    glBindAttribLocation(name_, 0, "ball");
    glBindAttribLocation(name_, 1, "color");
    glBindAttribLocation(name_, 2, "corner");
    glLinkProgram(name_);
    glDeleteShader(vertexShader);
    glDeleteShader(fragmentShader);

    GLint linked = GL_FALSE;
    glGetProgramiv(name_, GL_LINK_STATUS, &linked);
    if (linked) return;
    std::array<char, 1024> log{};
    glGetProgramInfoLog(name_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    glDeleteProgram(name_);
    refuse(log.data(), fragmentSource);
}

}  // namespace ballpit
