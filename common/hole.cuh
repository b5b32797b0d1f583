// TODO_HOLE marks a place that a student still has to write, and remembers that it was reached: so
// a check can tell "not started" from "wrong".
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "common/device.h"
#include "common/hd.h"
#ifdef __CUDACC__
#include "common/cuda_check.h"
#endif

#define TODO_HOLE(id) ::ballpit::reachHole(id)

namespace ballpit {

/// The holes reached so far, by the hash of their id. A key of 0 is a free place.
struct HoleTable {
    static constexpr int places = 64, longestId = 40;
    unsigned long long keys[places];
    char ids[places][longestId];
};

inline HoleTable& hostHoles() {
    static HoleTable table{};
    return table;
}

/// Called with the id when a hole is reached on the CPU for the first time; none by default. For
/// checks: a hole that was met before a crash is known although the program is gone.
inline void (*&holeListener())(const char* id) {
    static void (*listener)(const char* id) = nullptr;
    return listener;
}

#ifdef __CUDACC__
static __device__ HoleTable deviceHoles;
#endif

/// Puts key in a free place; returns what was there before: 0 if it was free.
HD inline unsigned long long claimPlace(unsigned long long& place, unsigned long long key) {
#ifdef __CUDA_ARCH__
    return atomicCAS(&place, 0ull, key);
#else
    unsigned long long seen = 0;
    std::atomic_ref(place).compare_exchange_strong(seen, key);
    return seen;
#endif
}

HD inline void reachHole(const char* id) {
    unsigned long long key = 0xCBF29CE484222325ull;  // FNV-1a
    for (const char* c = id; *c; ++c)
        key = (key ^ static_cast<unsigned char>(*c)) * 0x100000001B3ull;
#ifdef __CUDA_ARCH__
    HoleTable& table = deviceHoles;
#else
    HoleTable& table = hostHoles();
#endif
    for (int place = 0; place < HoleTable::places; ++place) {
        const unsigned long long before = claimPlace(table.keys[place], key);
        if (before == 0) {
            for (int k = 0; k + 1 < HoleTable::longestId && id[k]; ++k) table.ids[place][k] = id[k];
        }
        if (before == 0 || before == key) return;
    }
}

inline void addIds(const HoleTable& table, std::vector<std::string>& ids) {
    for (int place = 0; place < HoleTable::places; ++place)
        if (table.keys[place]) ids.emplace_back(table.ids[place]);
}

/// The ids of the holes reached on either machine since the last call. (In a build with CUDA: by
/// the kernels of the source file that calls this.)
inline std::vector<std::string> takeReachedHoles() {
    std::vector<std::string> ids;
    addIds(hostHoles(), ids);
    hostHoles() = {};
#ifdef __CUDACC__
    HoleTable table;
    // After a CUDA error the table cannot be read; the error itself is reported elsewhere.
    if (cudaUsable() && cudaMemcpyFromSymbol(&table, deviceHoles, sizeof table) == cudaSuccess) {
        addIds(table, ids);
        table = {};
        cudaMemcpyToSymbol(deviceHoles, &table, sizeof table);
    }
#endif
    return ids;
}

}  // namespace ballpit
