// Shader programs and vertex buffers that free themselves.
#pragma once

#include "common/vec3.cuh"

#include <GL/glew.h>

#include <string>

namespace ballpit {

/// Two shaders, linked. Its attributes 0, 1 and 2 are `ball`, `color` and `corner`. Throws
/// std::runtime_error with the driver's words and the line of the shader if it is refused.
class OpenGLProgram {
public:
    OpenGLProgram(const std::string& vertexSource, const std::string& fragmentSource);
    ~OpenGLProgram() { glDeleteProgram(name_); }
    OpenGLProgram(const OpenGLProgram&) = delete;
    OpenGLProgram& operator=(const OpenGLProgram&) = delete;

    void use() const { glUseProgram(name_); }

    // For the program in use.
    void set(const char* name, float x) const { glUniform1f(place(name), x); }
    void set(const char* name, float x, float y) const { glUniform2f(place(name), x, y); }
    void set(const char* name, Vec3 v) const { glUniform3f(place(name), v.x, v.y, v.z); }
    void setTexture(const char* name, int unit) const { glUniform1i(place(name), unit); }

private:
    GLint place(const char* name) const { return glGetUniformLocation(name_, name); }

    GLuint name_;
};

class OpenGLBuffer {
public:
    OpenGLBuffer() { glGenBuffers(1, &name_); }
    ~OpenGLBuffer() { glDeleteBuffers(1, &name_); }
    OpenGLBuffer(const OpenGLBuffer&) = delete;
    OpenGLBuffer& operator=(const OpenGLBuffer&) = delete;

    GLuint name() const { return name_; }
    void bind() const { glBindBuffer(GL_ARRAY_BUFFER, name_); }

    /// Replaces the content. Without `data` there is room for it, and no content.
    void fill(const void* data, std::size_t bytes, GLenum usage) const {
        bind();
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, usage);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
    }

    /// Attribute `index` is `floatCount` floats at `offset`, then again `stride` bytes further.
    void attribute(GLuint index, int floatCount, std::size_t offset, std::size_t stride) const {
        bind();
        glEnableVertexAttribArray(index);
        glVertexAttribPointer(index, floatCount, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                              reinterpret_cast<const void*>(offset));
        glBindBuffer(GL_ARRAY_BUFFER, 0);
    }

private:
    GLuint name_ = 0;
};

}  // namespace ballpit
