// Loops on several threads of the CPU.
#pragma once

#include <cstdint>

#include "common/device.h"

namespace ballpit {

/// Out of line, so that each loop is compiled once, whether one thread runs it or many.
template <class Turn>
[[gnu::noinline]] void takeTurns(int begin, int end, const Turn& turn) {
    for (int k = begin; k < end; ++k) turn(k);
}

/// turn(k) for every k in [0, count): a share on each thread of the CPU, or all on this one. That
/// is a plain loop then: OpenMP takes a microsecond even for a team of one, and a small scene's
/// step has hundreds of loops.
template <class Turn>
void forEachTurn(int count, bool onThreads, const Turn& turn) {
    if (!onThreads) return takeTurns(0, count, turn);
    const int threads = cpuThreadCount();
    const auto edge = [&](std::int64_t share) { return static_cast<int>(share * count / threads); };
#pragma omp parallel for schedule(static, 1)
    for (int share = 0; share < threads; ++share) takeTurns(edge(share), edge(share + 1), turn);
}

}  // namespace ballpit
