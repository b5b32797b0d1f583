// A CPU's stand-in for kernel<<<blocks, threads>>>: every thread of the grid, with the indices that
// CUDA would give it, surplus threads included.
#pragma once

#include "common/launch.cuh"

namespace ballpit {

#ifdef __CUDACC__
using GridIndex = uint3;  // the type of CUDA's threadIdx and blockIdx
#else
struct GridIndex {
    unsigned x = 0, y = 0, z = 0;
};
#endif

template <auto body, class... Args>
void emulatedThread(int place, int threadsPerBlock, Args... args) {
    const auto thread = static_cast<unsigned>(place), size = static_cast<unsigned>(threadsPerBlock);
    body(GridIndex{thread / size, 0, 0}, GridIndex{size, 1, 1}, GridIndex{thread % size, 0, 0},
         args...);
}

/// Runs body(blockIdx, blockDim, threadIdx, arguments...) for each of the blocks * threads threads
/// of a one-dimensional grid, in the launch order in force.
template <auto body, class... Args>
void emulateGrid(int blocks, int threads, Args... args) {
    loopOverIndices<emulatedThread<body, Args...>>(blocks * threads, threads, args...);
}

}  // namespace ballpit
