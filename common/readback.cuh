// A small record that the device fills and the host reads after every step.
#pragma once

#include <utility>

#include "common/buffer.cuh"

namespace ballpit {

/// One T on the device, and its copy in page-locked host memory, which a GPU can write without
/// help: so the copy can be part of a recorded step.
template <class T>
class Readback {
public:
    explicit Readback(Device device)
        : onDevice_(device, 1, "readback"),
          onHost_(static_cast<T*>(allocatePinned(device, sizeof(T)))) {}
    Readback(const Readback&) = delete;
    ~Readback() { releasePinned(onDevice_.device(), onHost_); }

    View<T> view() { return onDevice_.view(); }

    /// Copies to the host after the launches so far.
    void enqueueCopy() { copyToPinned(onDevice_.device(), onHost_, onDevice_.data(), sizeof(T)); }

    /// What was copied, once the device has got there.
    const T& wait() const {
        synchronize(onDevice_.device());
        return *onHost_;
    }

private:
    DeviceBuffer<T> onDevice_;
    T* onHost_;
};

}  // namespace ballpit
