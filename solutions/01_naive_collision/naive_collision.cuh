// Chapter 01: which balls touch? Every ball against every other: slow, simple, and the oracle that
// all later chapters are checked against.
#pragma once

#include "common/atomics.cuh"
#include "common/launch.cuh"
#include "common/pair_list.cuh"
#include "common/vec3.cuh"

namespace ballpit {

/// Two balls touch if their centres are nearer than the sum of their radii; at exactly that
/// distance they do not. `a`, `b`: x, y, z, radius in m. Squared, so that no root is needed.
HD inline bool spheresTouch(Vec4 a, Vec4 b) {
    const float reach = a.w + b.w;
    return lengthSquared(xyz(b) - xyz(a)) < reach * reach;
}

/// Blocks of `threads` threads each that cover `count` indices.
HD inline int blockCountFor(int count, int threads) { return (count + threads - 1) / threads; }

/// Takes the next free place of the list and writes the pair there if there is room. `found`
/// counts every pair, stored or not, so that the caller sees how many were needed.
HD inline void appendPair(Pair pair, View<Pair> pairs, std::uint32_t& found) {
    const std::uint32_t place = fetchAdd(found, 1);
    if (place < pairs.count) pairs[place] = pair;
}

/// Thread `thread` compares ball i = thread with every ball after it. Threads past the last ball
/// have nothing to do: there are more threads than balls unless the count fills the last block.
HD inline void findPairsNaive(int thread, int count, View<const Vec4> positions, View<Pair> pairs,
                              View<std::uint32_t> found) {
    if (thread >= count) return;
    const Vec4 mine = positions[thread];
    for (int other = thread + 1; other < count; ++other) {
        if (spheresTouch(mine, positions[other]))
            appendPair({static_cast<std::uint32_t>(thread), static_cast<std::uint32_t>(other)},
                       pairs, found[0]);
    }
}

#ifdef __CUDACC__
static __global__ void findPairsNaiveKernel(int count, View<const Vec4> positions, View<Pair> pairs,
                                            View<std::uint32_t> found) {
    const int thread = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    findPairsNaive(thread, count, positions, pairs, found);
}
#endif

/// All touching pairs of `positions`, in any order. `found` has one element and is zero; it
/// receives the number of pairs, also beyond the capacity of `pairs`. A raw launch: from chapter
/// 02 on, launch<body> does this.
inline void launchFindPairsNaive(Device device, int count, View<const Vec4> positions,
                                 View<Pair> pairs, View<std::uint32_t> found) {
    if (count == 0) return;
#ifdef __CUDACC__
    if (device == Device::cuda) {
        const int blocks = blockCountFor(count, threadsPerBlock);
        findPairsNaiveKernel<<<blocks, threadsPerBlock, 0, cudaStream>>>(count, positions, pairs,
                                                                         found);
        return checkCuda(cudaGetLastError(), "findPairsNaiveKernel");
    }
#endif
    // The CPU's grid of blocks and threads: the same indices, surplus threads included.
    const int threads = blockCountFor(count, threadsPerBlock) * threadsPerBlock;
    launch<findPairsNaive>(device, threads, count, positions, pairs, found);
}

}  // namespace ballpit
