// Device memory and device facts. Compiled by nvcc with CUDA, by the host compiler without.
#include "common/device.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "common/error.h"

#ifdef _OPENMP
#include <omp.h>
#endif
#ifdef BALLPIT_CUDA
#include "common/cuda_check.h"
#endif

namespace ballpit {

namespace {

constexpr std::size_t cacheLine = 64, hugePage = std::size_t{2} << 20;

std::string megabytes(std::size_t bytes) { return std::to_string((bytes >> 20) + 1) + " MiB"; }

/// The value in kB of one line of /proc/meminfo, or 0.
std::size_t memoryInfoKilobytes(const std::string& key) {
    std::ifstream file("/proc/meminfo");
    std::string word;
    std::size_t kilobytes = 0;
    while (file >> word) {
        if (word == key && file >> kilobytes) return kilobytes;
    }
    return 0;
}

std::string cpuModel() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const auto colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
            return line.substr(colon + 2);
    }
    return "CPU";
}

}  // namespace

int cpuThreadCount() {
#ifdef _OPENMP
    return omp_get_max_threads();
#else
    return 1;
#endif
}

Device defaultDevice() { return cudaUsable() ? Device::cuda : Device::cpu; }

const char* name(Device device) { return device == Device::cuda ? "cuda" : "cpu"; }

#ifdef BALLPIT_CUDA

void checkCuda(cudaError_t code, const char* call, std::source_location place) {
    if (code == cudaSuccess) return;
    const char* cause = "";
    if (code == cudaErrorNoKernelImageForDevice)
        cause =
            " (likely cause: built for another GPU; configure again with "
            "-DCMAKE_CUDA_ARCHITECTURES=native)";
    if (code == cudaErrorInsufficientDriver)
        cause = " (likely cause: the driver is older than the CUDA toolkit of this build)";
    if (code == cudaErrorIllegalAddress)
        cause =
            " (likely cause: an index out of range in a kernel; run the checked build, "
            "preset cuda-debug, or compute-sanitizer)";
    if (code == cudaErrorMemoryAllocation) cause = " (likely cause: too many balls for this GPU)";
    throw CudaError(std::string("CUDA error in ") + call + " at " + place.file_name() + ":" +
                    std::to_string(place.line()) + ": " + cudaGetErrorString(code) + cause);
}

namespace {

cudaError_t cudaProbe() {
    static const cudaError_t result = [] {
        int count = 0;
        const cudaError_t code = cudaGetDeviceCount(&count);
        return code == cudaSuccess && count == 0 ? cudaErrorNoDevice : code;
    }();
    return result;
}

}  // namespace

bool cudaUsable() { return cudaProbe() == cudaSuccess; }

std::string whyCudaIsUnusable() {
    return std::string("no usable GPU (") + cudaGetErrorString(cudaProbe()) +
           "): use --device cpu, which runs the same kernels";
}

#else

bool cudaUsable() { return false; }

std::string whyCudaIsUnusable() {
    return "this build has no CUDA code: use --device cpu, which runs the same kernels, or build "
           "with --cuda on a machine with nvcc and an NVIDIA GPU";
}

#endif

void requireUsable(Device device) {
    if (device == Device::cuda && !cudaUsable())
        throw InputError("--device cuda: " + whyCudaIsUnusable());
}

std::string describe(Device device) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) {
        cudaDeviceProp properties{};
        checkCuda(cudaGetDeviceProperties(&properties, 0), "cudaGetDeviceProperties");
        return properties.name;
    }
#endif
    (void)device;
    return cpuModel() + ", " + std::to_string(cpuThreadCount()) + " threads";
}

std::size_t freeMemory(Device device) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) {
        std::size_t available = 0, total = 0;
        checkCuda(cudaMemGetInfo(&available, &total), "cudaMemGetInfo");
        return available;
    }
#endif
    (void)device;
    return memoryInfoKilobytes("MemAvailable:") * 1024;
}

void* allocateBytes(Device device, std::size_t bytes) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) {
        void* data = nullptr;
        const std::string call = "cudaMalloc of " + megabytes(bytes);
        checkCuda(cudaMalloc(&data, std::max(bytes, cacheLine)), call.c_str());
        return data;
    }
#endif
    (void)device;
    // Large arrays on large pages: scattered reads then miss the page table's cache less often.
    const std::size_t alignment = bytes >= hugePage ? hugePage : cacheLine;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void* data = std::aligned_alloc(alignment, std::max(rounded, cacheLine));
    if (data && alignment == hugePage) madvise(data, rounded, MADV_HUGEPAGE);
    if (!data) throw std::runtime_error("out of memory: no " + megabytes(bytes) + " left");
    return data;
}

void releaseBytes(Device device, void* data) noexcept {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) {
        cudaFree(data);
        return;
    }
#endif
    (void)device;
    std::free(data);
}

#ifdef BALLPIT_CUDA
namespace {

void copyOnStream(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind) {
    checkCuda(cudaMemcpyAsync(to, from, bytes, kind, cudaStream), "cudaMemcpyAsync");
    if (kind != cudaMemcpyDeviceToDevice) synchronize(Device::cuda);
}

}  // namespace
#endif

void copyToDevice(Device device, void* to, const void* from, std::size_t bytes) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) return copyOnStream(to, from, bytes, cudaMemcpyHostToDevice);
#endif
    (void)device;
    if (bytes) std::memcpy(to, from, bytes);
}

void copyToHost(Device device, void* to, const void* from, std::size_t bytes) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) return copyOnStream(to, from, bytes, cudaMemcpyDeviceToHost);
#endif
    (void)device;
    if (bytes) std::memcpy(to, from, bytes);
}

void copyWithin(Device device, void* to, const void* from, std::size_t bytes) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) return copyOnStream(to, from, bytes, cudaMemcpyDeviceToDevice);
#endif
    (void)device;
    if (bytes) std::memcpy(to, from, bytes);
}

void fillBytes(Device device, void* data, int byte, std::size_t bytes) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda)
        return checkCuda(cudaMemsetAsync(data, byte, bytes, cudaStream), "cudaMemsetAsync");
#endif
    (void)device;
    if (bytes) std::memset(data, byte, bytes);
}

void* allocatePinned(Device device, std::size_t bytes) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) {
        void* data = nullptr;
        checkCuda(cudaMallocHost(&data, bytes), "cudaMallocHost");
        return data;
    }
#endif
    return allocateBytes(device, bytes);
}

void releasePinned(Device device, void* data) noexcept {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) {
        cudaFreeHost(data);
        return;
    }
#endif
    releaseBytes(device, data);
}

void copyToPinned(Device device, void* to, const void* from, std::size_t bytes) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda)
        return checkCuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, cudaStream),
                         "cudaMemcpyAsync");
#endif
    copyToHost(device, to, from, bytes);
}

void synchronize(Device device) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda)
        checkCuda(cudaStreamSynchronize(cudaStream), "cudaStreamSynchronize");
#endif
    (void)device;
}

}  // namespace ballpit
