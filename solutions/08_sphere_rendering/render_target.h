// A framebuffer object: where pictures are drawn when there is no window.
#pragma once

#include <GL/glew.h>

#include <array>
#include <string>

#include "common/error.h"

namespace ballpit {

/// Colour and depth of one size.
class RenderTarget {
public:
    RenderTarget(int width, int height) : width_(width), height_(height) {
        GLint limit = 0;
        glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
        const std::string size = std::to_string(width) + "x" + std::to_string(height);
        if (width < 1 || height < 1 || width > limit || height > limit)
            throw InputError("frame size " + size + ": width and height must be from 1 to " +
                             std::to_string(limit));
        glGenFramebuffers(1, &name_);
        glBindFramebuffer(GL_FRAMEBUFFER, name_);
        glGenRenderbuffers(2, renderbuffers_.data());
        attach(GL_COLOR_ATTACHMENT0, renderbuffers_[0], GL_RGBA8);
        attach(GL_DEPTH_ATTACHMENT, renderbuffers_[1], GL_DEPTH_COMPONENT24);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
        release();
        throw InputError("OpenGL cannot draw frames of " + size + "; choose a smaller size");
    }
    ~RenderTarget() { release(); }
    RenderTarget(const RenderTarget&) = delete;
    RenderTarget& operator=(const RenderTarget&) = delete;

    GLuint name() const { return name_; }

    /// Drawing and reading go here from now on.
    void bind() const {
        glBindFramebuffer(GL_FRAMEBUFFER, name_);
        glViewport(0, 0, width_, height_);
    }

private:
    void attach(GLenum role, GLuint buffer, GLenum format) const {
        glBindRenderbuffer(GL_RENDERBUFFER, buffer);
        glRenderbufferStorage(GL_RENDERBUFFER, format, width_, height_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, role, GL_RENDERBUFFER, buffer);
    }

    void release() const {
        glDeleteFramebuffers(1, &name_);
        glDeleteRenderbuffers(2, renderbuffers_.data());
    }

    GLuint name_ = 0;
    std::array<GLuint, 2> renderbuffers_{};  // colour, depth
    int width_, height_;
};

}  // namespace ballpit
