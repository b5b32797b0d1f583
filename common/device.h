// The two machines a kernel can run on, and the raw memory of each.
#pragma once

#include <cstddef>
#include <string>

namespace ballpit {

enum class Device { cpu, cuda };

/// On a CPU, loops over fewer elements than this run on one thread: waking the others would cost
/// more than they save.
constexpr int serialCount = 2048;

/// True if this build contains CUDA code and a GPU answers.
bool cudaUsable();

/// Why cudaUsable() is false, and what would change it: one line for the user.
std::string whyCudaIsUnusable();

/// InputError, naming the option --device, if the device cannot be used.
void requireUsable(Device device);

/// The GPU where one can be used, else the CPU.
Device defaultDevice();

/// "cpu" or "cuda", as on the command line.
const char* name(Device device);

/// The machine's own name: the GPU's model, or the CPU with its thread count.
std::string describe(Device device);

/// Threads that the CPU's loops run on.
int cpuThreadCount();

/// Bytes that can still be allocated on the device.
std::size_t freeMemory(Device device);

// Raw memory, used by DeviceBuffer alone. Every call throws on failure, naming the bytes asked
// for. Copies and fills run in the order of the kernels launched before them.
void* allocateBytes(Device device, std::size_t bytes);
void releaseBytes(Device device, void* data) noexcept;
void copyToDevice(Device device, void* to, const void* from, std::size_t bytes);
void copyToHost(Device device, void* to, const void* from, std::size_t bytes);
void copyWithin(Device device, void* to, const void* from, std::size_t bytes);
void fillBytes(Device device, void* data, int byte, std::size_t bytes);

// Page-locked host memory, used by Readback alone. The copy does not wait for the device.
void* allocatePinned(Device device, std::size_t bytes);
void releasePinned(Device device, void* data) noexcept;
void copyToPinned(Device device, void* to, const void* from, std::size_t bytes);

/// Returns when all work given to the device is done.
void synchronize(Device device);

}  // namespace ballpit
