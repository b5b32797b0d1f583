// Ball positions on their way from the physics to OpenGL: on one GPU they never leave it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace ballpit {

class RigidBodySystem;

/// Fills an OpenGL buffer with (x, y, z, radius) for every body, in body order. Where CUDA and
/// OpenGL run on the same GPU, a kernel writes straight into the buffer. Everywhere else (bodies on
/// the CPU, OpenGL in software or on another GPU, a driver that refuses) the values are copied
/// through main memory: slower, the same picture.
class SharedVertices {
public:
    /// `buffer`: an OpenGL buffer of at least 16 bytes a body. It must outlive this object, and the
    /// context in which it was made must be current in every call. Without `mayShare` the way
    /// through main memory is taken in any case, to compare.
    SharedVertices(RigidBodySystem& bodies, unsigned buffer, bool mayShare = true);
    ~SharedVertices();
    SharedVertices(const SharedVertices&) = delete;

    /// Brings the buffer up to the committed state of the bodies.
    void update();

    /// True if a kernel writes into the buffer.
    bool isDirect() const;
    /// Why not, in one line; empty if it does, or if the bodies are on the CPU anyway.
    const std::string& notice() const { return notice_; }

private:
    struct Registration;

    void updateThroughHost();

    RigidBodySystem& bodies_;
    unsigned buffer_;
    std::unique_ptr<Registration> registration_;
    std::string notice_;
};

}  // namespace ballpit
