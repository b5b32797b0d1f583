// launch<body>(device, count, arguments...) runs body(i, arguments...) for every i in [0, count):
// one CUDA thread each on a GPU, one turn of a loop each on a CPU. A body must not care about the
// order: it reads what no other index writes.
#pragma once

#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "common/device.h"
#include "common/hd.h"
#include "common/parallel.h"

#ifdef __CUDACC__
#include "common/cuda_check.h"
#elif defined(BALLPIT_CUDA)
#error "this file launches kernels: give it the ending .cu, so that CUDA's compiler sees it"
#endif

namespace ballpit {

/// The order in which the CPU takes the indices. A correct kernel gives the same bits in each, so
/// a test that changes the order finds races without a GPU.
enum class LaunchOrder { forward, reversed, shuffled };

/// The order in force; tests change it. (The one switch of the engine that is not an argument: a
/// test must be able to turn it under code that knows nothing of it.)
inline LaunchOrder& launchOrder() {
    static LaunchOrder order = LaunchOrder::forward;
    return order;
}

/// Where turn k of `count` goes: a permutation of [0, count) for every order.
inline int indexInOrder(LaunchOrder order, int k, int count) {
    if (order == LaunchOrder::forward) return k;
    if (order == LaunchOrder::reversed) return count - 1 - k;
    // A stride without common divisor with count visits every index once.
    std::int64_t stride = static_cast<std::int64_t>(0.618 * count) | 1;
    while (std::gcd(stride, static_cast<std::int64_t>(count)) != 1) stride += 2;
    return static_cast<int>(k * stride % count);
}

constexpr int threadsPerBlock = 256;
/// Of the one block of launchPhases.
constexpr int threadsOfPhases = 512;

#ifdef __CUDACC__
template <auto body, class... Args>
__global__ void threadPerIndex(int count, Args... args) {
    const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count) body(i, args...);
}

template <auto body, class... Args>
__global__ void __launch_bounds__(threadsOfPhases) phasesOfOneBlock(int phases, Args... args) {
    const int thread = static_cast<int>(threadIdx.x), threads = static_cast<int>(blockDim.x);
    for (int phase = 0; phase < phases; ++phase)
        if (!__syncthreads_or(body(phase, thread, threads, args...))) return;
}
#endif

template <auto body, class... Args>
void loopOverIndices(int count, const Args&... args) {
    const LaunchOrder order = launchOrder();
    forEachTurn(count, count >= serialCount,
                [&](int k) { body(indexInOrder(order, k, count), args...); });
}

template <auto body, class... Args>
void launch(Device device, int count, const Args&... args) {
    if (count <= 0) return;
    if (device == Device::cpu) return loopOverIndices<body>(count, args...);
#ifdef __CUDACC__
    const int blocks = (count + threadsPerBlock - 1) / threadsPerBlock;
    threadPerIndex<body><<<blocks, threadsPerBlock, 0, cudaStream>>>(count, args...);
    checkCuda(cudaGetLastError(), __PRETTY_FUNCTION__);
#else
    throw std::logic_error("a launch on a GPU in a build without CUDA");
#endif
}

/// Up to `phases` phases, one after the other: body(phase, thread, threads, arguments...) does a
/// thread's share of each and says whether it wants another; the last is the one after which no
/// thread does. How many threads there are must not show. For little work a phase: on a GPU one
/// block does it, whose threads can wait for each other, since a launch takes longer than a phase.
template <auto body, class... Args>
void launchPhases(Device device, int phases, const Args&... args) {
    if (device == Device::cpu) {
        for (int phase = 0; phase < phases && body(phase, 0, 1, args...);) ++phase;
        return;
    }
#ifdef __CUDACC__
    phasesOfOneBlock<body><<<1, threadsOfPhases, 0, cudaStream>>>(phases, args...);
    checkCuda(cudaGetLastError(), __PRETTY_FUNCTION__);
#else
    throw std::logic_error("a launch on a GPU in a build without CUDA");
#endif
}

}  // namespace ballpit
