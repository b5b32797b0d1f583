// Chooses between CUB and the CPU's loops. The only file that includes CUB.
#include "common/algorithms.h"

#include "common/algorithms_cpu.h"

#ifdef BALLPIT_CUDA
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>

#include <cub/cub.cuh>

#include "common/cuda_check.h"
#endif

namespace ballpit {

#ifdef BALLPIT_CUDA
namespace {

/// Calls a CUB algorithm the two times it wants: once for its scratch size, once for the work.
template <class Algorithm>
void withScratch(Scratch& scratch, const char* call, Algorithm algorithm) {
    std::size_t bytes = 0;
    checkCuda(algorithm(nullptr, bytes), call);
    if (bytes > scratch.bytes()) scratch.resize(bytes);
    checkCuda(algorithm(scratch.data(), bytes), call);
}

/// counts[i], and 0 past the end: lets one exclusive scan of count + 1 elements give the total.
struct PaddedCounts {
    const std::uint32_t* counts;
    int count;
    __device__ std::uint32_t operator()(int i) const { return i < count ? counts[i] : 0u; }
};

}  // namespace
#endif

void sortPairs(Device device, int count, int keyBits, std::uint32_t* keys, std::uint32_t* values,
               std::uint32_t* sortedKeys, std::uint32_t* sortedValues, Scratch& scratch) {
    if (count <= 0) return;
#ifdef BALLPIT_CUDA
    if (device == Device::cuda)
        return withScratch(scratch, "cub::DeviceRadixSort::SortPairs", [&](void* space, auto& n) {
            return cub::DeviceRadixSort::SortPairs(space, n, keys, sortedKeys, values, sortedValues,
                                                   count, 0, keyBits, cudaStream);
        });
#endif
    (void)device, (void)scratch;
    cpu::sortPairs(count, keyBits, keys, values, sortedKeys, sortedValues);
}

void exclusiveScan(Device device, int count, const std::uint32_t* counts, std::uint32_t* starts,
                   Scratch& scratch) {
#ifdef BALLPIT_CUDA
    if (device == Device::cuda)
        return withScratch(scratch, "cub::DeviceScan::ExclusiveSum", [&](void* space, auto& n) {
            const auto padded = thrust::make_transform_iterator(thrust::make_counting_iterator(0),
                                                                PaddedCounts{counts, count});
            return cub::DeviceScan::ExclusiveSum(space, n, padded, starts, count + 1, cudaStream);
        });
#endif
    (void)device, (void)scratch;
    cpu::exclusiveScan(count, counts, starts);
}

float reduceMaximum(Device device, int count, const float* values, Scratch& scratch) {
    if (count <= 0) return 0.0f;
#ifdef BALLPIT_CUDA
    if (device == Device::cuda) {
        DeviceBuffer<float> result(device, 1, "maximum");
        withScratch(scratch, "cub::DeviceReduce::Max", [&](void* space, auto& n) {
            return cub::DeviceReduce::Max(space, n, values, result.data(), count, cudaStream);
        });
        return result.download()[0];
    }
#endif
    (void)device, (void)scratch;
    return cpu::reduceMaximum(count, values);
}

}  // namespace ballpit
