// Sort, scan and reduce on the CPU. The work is cut into one contiguous chunk a thread; the results
// do not depend on how many chunks there are.
#include "common/algorithms_cpu.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "common/device.h"
#include "common/parallel.h"

namespace ballpit::cpu {

namespace {

/// 2^11 counters fit the first-level cache, and 22 bits of cell hash take two passes.
constexpr int maxDigitBits = 11;

int chunkCountFor(int count) { return count >= serialCount ? cpuThreadCount() : 1; }

struct Chunk {
    int begin, end;
};

Chunk chunkOf(int chunk, int chunkCount, int count) {
    const auto edge = [&](std::int64_t c) { return static_cast<int>(c * count / chunkCount); };
    return {edge(chunk), edge(chunk + 1)};
}

/// visit(c, chunk) for every chunk c of `count` elements, one a thread.
template <class Visit>
void forEachChunk(int chunkCount, int count, Visit visit) {
    forEachTurn(chunkCount, chunkCount > 1,
                [&](int c) { visit(static_cast<std::size_t>(c), chunkOf(c, chunkCount, count)); });
}

using Histogram = std::array<std::uint32_t, 1 << maxDigitBits>;

/// Turns the chunks' digit counts into each chunk's first slot for each digit: digit by digit, and
/// within a digit chunk by chunk, which keeps the sort stable.
void countsToSlots(std::vector<Histogram>& histograms, std::uint32_t digits) {
    std::uint32_t slot = 0;
    for (std::uint32_t digit = 0; digit < digits; ++digit) {
        for (Histogram& histogram : histograms) {
            slot += std::exchange(histogram[digit], slot);
        }
    }
}

/// One stable pass over `bits` bits from `shift`.
void sortPass(int count, int shift, int bits, const std::uint32_t* keys,
              const std::uint32_t* values, std::uint32_t* outKeys, std::uint32_t* outValues) {
    const int chunkCount = chunkCountFor(count);
    const std::uint32_t mask = (1u << bits) - 1u;
    std::vector<Histogram> histograms(static_cast<std::size_t>(chunkCount));

    forEachChunk(chunkCount, count, [&](std::size_t c, Chunk chunk) {
        Histogram& histogram = histograms[c];
        histogram.fill(0);
        for (int i = chunk.begin; i < chunk.end; ++i) ++histogram[keys[i] >> shift & mask];
    });

    countsToSlots(histograms, mask + 1u);

    forEachChunk(chunkCount, count, [&](std::size_t c, Chunk chunk) {
        Histogram& next = histograms[c];
        for (int i = chunk.begin; i < chunk.end; ++i) {
            const std::uint32_t slot = next[keys[i] >> shift & mask]++;
            outKeys[slot] = keys[i];
            outValues[slot] = values[i];
        }
    });
}

}  // namespace

void sortPairs(int count, int keyBits, std::uint32_t* keys, std::uint32_t* values,
               std::uint32_t* sortedKeys, std::uint32_t* sortedValues) {
    const int passes = std::max(1, (keyBits + maxDigitBits - 1) / maxDigitBits);
    const int bits = (keyBits + passes - 1) / passes;
    std::uint32_t *fromKeys = keys, *fromValues = values, *toKeys = sortedKeys,
                  *toValues = sortedValues;
    for (int pass = 0; pass < passes; ++pass) {
        const int shift = pass * bits;
        sortPass(count, shift, std::min(bits, keyBits - shift), fromKeys, fromValues, toKeys,
                 toValues);
        std::swap(fromKeys, toKeys);
        std::swap(fromValues, toValues);
    }
    if (fromKeys != sortedKeys) {
        std::copy(fromKeys, fromKeys + count, sortedKeys);
        std::copy(fromValues, fromValues + count, sortedValues);
    }
}

void exclusiveScan(int count, const std::uint32_t* counts, std::uint32_t* starts) {
    const int chunkCount = chunkCountFor(count);
    std::vector<std::uint32_t> sums(static_cast<std::size_t>(chunkCount) + 1, 0);

    forEachChunk(chunkCount, count, [&](std::size_t c, Chunk chunk) {
        std::uint32_t sum = 0;
        for (int i = chunk.begin; i < chunk.end; ++i) sum += counts[i];
        sums[c + 1] = sum;
    });

    for (std::size_t c = 1; c < sums.size(); ++c) sums[c] += sums[c - 1];

    forEachChunk(chunkCount, count, [&](std::size_t c, Chunk chunk) {
        std::uint32_t sum = sums[c];
        for (int i = chunk.begin; i < chunk.end; ++i) {
            starts[i] = sum;
            sum += counts[i];
        }
    });
    starts[count] = sums.back();
}

float reduceMaximum(int count, const float* values) {
    std::vector<float> largest(static_cast<std::size_t>(chunkCountFor(count)), values[0]);
    forEachChunk(static_cast<int>(largest.size()), count, [&](std::size_t c, Chunk chunk) {
        for (int i = chunk.begin; i < chunk.end; ++i) largest[c] = std::max(largest[c], values[i]);
    });
    return *std::max_element(largest.begin(), largest.end());
}

}  // namespace ballpit::cpu
