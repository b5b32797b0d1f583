// DeviceBuffer owns an array on one device; View is what kernels get of it.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/device.h"
#include "common/hd.h"

namespace ballpit {

#ifdef BALLPIT_CHECKED
/// Ends the program with the array's name and the index: a kernel read or wrote out of bounds.
HD inline void reportOutOfBounds(const char* array, long long index, long long count) {
    printf("out of bounds: %s[%lld], but it has %lld elements\n", array, index, count);
#ifdef __CUDA_ARCH__
    __trap();
#else
    std::fflush(stdout);
    std::abort();
#endif
}
#endif

/// A window on an array in a device's memory, passed to kernels by value. In checked builds
/// (Debug) every access is tested against the bounds; in release builds it is a bare pointer.
template <class T>
struct View {
    T* data = nullptr;
    std::uint32_t count = 0;
#ifdef BALLPIT_CHECKED
    // A fixed array, since a host string's address means nothing to a GPU.
    char name[24] = "array";
#endif

    template <class Index>
    HD T& operator[](Index i) const {
#ifdef BALLPIT_CHECKED
        if (static_cast<unsigned long long>(i) >= count)  // a negative i becomes huge
            reportOutOfBounds(name, static_cast<long long>(i), count);
#endif
        return data[i];
    }

    /// A view that only reads.
    template <class Reading = const T>
    requires(!std::is_const_v<T>) HD operator View<Reading>() const {
        View<Reading> reading;
        reading.data = data;
        reading.count = count;
#ifdef BALLPIT_CHECKED
        for (int k = 0; k < 24; ++k) reading.name[k] = name[k];
#endif
        return reading;
    }
};

/// An array of trivially copyable T on one device. Move-only; frees its memory itself. New
/// memory is zero, or NaN patterns in checked builds so that reading before writing shows.
template <class T>
class DeviceBuffer {
public:
    DeviceBuffer(Device device, std::size_t count, const char* name = "array")
        : device_(device), name_(name) {
        resize(count);
    }
    DeviceBuffer(DeviceBuffer&& other) noexcept { swap(other); }
    DeviceBuffer& operator=(DeviceBuffer&& other) noexcept {
        swap(other);
        return *this;
    }
    ~DeviceBuffer() {
        if (data_) releaseBytes(device_, data_);
    }

    /// Changes the size; the old content is lost.
    void resize(std::size_t count) {
        if (data_) releaseBytes(device_, std::exchange(data_, nullptr));
        count_ = 0;
        data_ = static_cast<T*>(allocateBytes(device_, count * sizeof(T)));
        count_ = count;
#ifdef BALLPIT_CHECKED
        fillBytes(device_, data_, 0xFF, bytes());
#else
        fillBytes(device_, data_, 0, bytes());
#endif
    }

    /// Copies host data in; sizes must match.
    void upload(std::span<const T> host) {
        requireCount(host.size(), "upload");
        copyToDevice(device_, data_, host.data(), bytes());
    }

    /// Copies all to the host.
    std::vector<T> download() const { return download(count_); }

    /// Copies the first `count` elements to the host.
    std::vector<T> download(std::size_t count) const {
        if (count > count_) requireCount(count, "download");
        std::vector<T> host(count);
        copyToHost(device_, host.data(), data_, count * sizeof(T));
        return host;
    }

    /// Sets every byte.
    void fill(int byte) { fillBytes(device_, data_, byte, bytes()); }

    View<T> view() {
        View<T> window;
        window.data = data_;
        window.count = static_cast<std::uint32_t>(count_);
#ifdef BALLPIT_CHECKED
        std::snprintf(window.name, sizeof window.name, "%s", name_);
#endif
        return window;
    }

    T* data() { return data_; }
    const T* data() const { return data_; }
    std::size_t count() const { return count_; }
    std::size_t bytes() const { return count_ * sizeof(T); }
    Device device() const { return device_; }

private:
    void swap(DeviceBuffer& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(data_, other.data_);
        std::swap(count_, other.count_);
        std::swap(name_, other.name_);
    }
    void requireCount(std::size_t given, const char* what) const {
        if (given != count_)
            throw std::invalid_argument(std::string(what) + " of " + std::to_string(given) +
                                        " elements, but " + name_ + " has " +
                                        std::to_string(count_));
    }

    Device device_ = Device::cpu;
    T* data_ = nullptr;
    std::size_t count_ = 0;
    const char* name_ = "array";
};

}  // namespace ballpit
