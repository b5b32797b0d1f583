// Chapter 01: which balls touch? Every ball against every other: slow, simple, and the oracle that
// all later chapters are checked against.
#pragma once

#include "common/atomics.cuh"
#include "common/emulated_grid.cuh"
//@starter #include "common/hole.cuh"
#include "common/pair_list.cuh"
#include "common/vec3.cuh"

namespace ballpit {

/// Two balls touch if their centres are nearer than the sum of their radii; at exactly that
/// distance they do not. `a`, `b`: x, y, z, radius in m. Squared, so that no root is needed.
HD inline bool spheresTouch(Vec4 a, Vec4 b) {
    //@hole naive.touch lines=2 "Do two balls touch? Compare squares: no root is needed"
    //@starter TODO_HOLE("naive.touch");
    //@starter return false;
    const float reach = a.w + b.w;
    return lengthSquared(xyz(b) - xyz(a)) < reach * reach;
    //@end
}

/// Blocks of `threads` threads each that cover `count` balls: just enough, none for no balls.
HD inline int blockCountFor(int count, int threads) {
    //@hole naive.blocks lines=1 "How many blocks give every ball a thread?"
    //@starter TODO_HOLE("naive.blocks");
    //@starter return 0;
    return (count + threads - 1) / threads;
    //@end
}

/// The thread's number in the whole grid, counted through all blocks. The parameters have the names
/// of the variables that CUDA gives every kernel.
HD inline int threadNumber(GridIndex blockIdx, GridIndex blockDim, GridIndex threadIdx) {
    //@hole naive.thread lines=1 "Which thread of the whole grid am I?"
    //@starter TODO_HOLE("naive.thread");
    //@starter return 0;
    return static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    //@end
}

HD inline Pair pairOf(int first, int second) {
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)};
}

/// Takes the next free place of the list, and writes the pair there if there is room. found[0]
/// counts every pair, stored or not, so that the caller sees how many places were needed.
HD inline void appendPair(Pair pair, View<Pair> pairs, View<std::uint32_t> found) {
    //@hole naive.append lines=2 "Take a place of its own; store what fits"
    //@starter TODO_HOLE("naive.append");
    const std::uint32_t place = fetchAdd(found[0], 1);
    if (place < pairs.count) pairs[place] = pair;
    //@end
}

/// Compares ball i with every ball before it and appends each touching pair, smaller number first.
HD inline void findPartners(int i, View<const Vec4> positions, View<Pair> pairs,
                            View<std::uint32_t> found) {
    //@hole naive.loop lines=4 "Append each ball before i that touches it"
    //@starter TODO_HOLE("naive.loop");
    const Vec4 mine = positions[i];
    for (int other = 0; other < i; ++other) {
        if (spheresTouch(positions[other], mine)) appendPair(pairOf(other, i), pairs, found);
    }
    //@end
}

/// What one thread does: it finds the partners of one ball. Only the first `count` of `positions`
/// are balls, and a grid of whole blocks has more threads than that.
HD inline void findPairsNaive(GridIndex blockIdx, GridIndex blockDim, GridIndex threadIdx,
                              int count, View<const Vec4> positions, View<Pair> pairs,
                              View<std::uint32_t> found) {
    const int i = threadNumber(blockIdx, blockDim, threadIdx);
    //@hole naive.guard lines=1 "A thread without a ball has nothing to do"
    //@starter TODO_HOLE("naive.guard");
    //@starter return;
    if (i >= count) return;
    //@end
    findPartners(i, positions, pairs, found);
}

//@show launch
#ifdef __CUDACC__
static __global__ void findPairsNaiveKernel(int count, View<const Vec4> positions, View<Pair> pairs,
                                            View<std::uint32_t> found) {
    findPairsNaive(blockIdx, blockDim, threadIdx, count, positions, pairs, found);
}
#endif

/// All touching pairs of the first `count` of `positions`, in any order. `found` has one element
/// and is zero; it receives the number of pairs, also beyond the capacity of `pairs`.
inline void launchFindPairsNaive(Device device, int count, View<const Vec4> positions,
                                 View<Pair> pairs, View<std::uint32_t> found) {
    const int blocks = blockCountFor(count, threadsPerBlock);
    if (blocks == 0) return;  // CUDA refuses an empty grid
    if (device == Device::cpu)
        return emulateGrid<findPairsNaive>(blocks, threadsPerBlock, count, positions, pairs, found);
#ifdef __CUDACC__
    findPairsNaiveKernel<<<blocks, threadsPerBlock, 0, cudaStream>>>(count, positions, pairs,
                                                                     found);
    checkCuda(cudaGetLastError(), "findPairsNaiveKernel");
#else
    throw std::logic_error("a launch on a GPU in a build without CUDA");
#endif
}
//@end

}  // namespace ballpit
