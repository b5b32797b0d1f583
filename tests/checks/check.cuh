// The part of the check library that must be compiled with the piece it checks.
#pragma once

#ifdef _OPENMP
#include <omp.h>
#endif

#include "common/buffer.cuh"
#include "common/hole.cuh"
#include "common/launch.cuh"
#include "tests/checks/check.h"

namespace ballpit::check {

/// Sets launch order and thread count for a scope.
class Threads {
public:
    Threads(LaunchOrder order, int count) : orderBefore_(launchOrder()), before_(cpuThreadCount()) {
        launchOrder() = order;
        setCount(count);
    }
    ~Threads() {
        launchOrder() = orderBefore_;
        setCount(before_);
    }
    Threads(const Threads&) = delete;

private:
    static void setCount(int count) {
#ifdef _OPENMP
        omp_set_num_threads(count);
#else
        (void)count;
#endif
    }
    LaunchOrder orderBefore_;
    int before_;
};

/// Calls `compute` once in order on one thread, then in other orders and with several threads; on
/// a GPU several times. Reports a race if a result differs, and returns the first. Loops shorter
/// than serialCount run on one thread anyway: give it more elements than that.
template <class Compute>
auto inEveryOrder(Report& report, Compute compute) {
    struct Way {
        const char* name;
        LaunchOrder order;
        int threads;
    };
    const auto resultOf = [&](const Way& way) {
        const Threads threads(way.order, way.threads);
        return compute();
    };
    const auto first = resultOf({"forward", LaunchOrder::forward, 1});
    for (const Way& way : {Way{"last thread first", LaunchOrder::reversed, 1},
                           Way{"shuffled threads", LaunchOrder::shuffled, 1},
                           Way{"two threads at once", LaunchOrder::forward, 2},
                           Way{"three threads at once", LaunchOrder::shuffled, 3}}) {
        if (report.isRacy) break;
        if (!(resultOf(way) == first))
            report.racy(report.device == Device::cuda ? "another run differs" : way.name);
    }
    return first;
}

/// An array on the report's device with this content.
template <class T>
DeviceBuffer<T> uploaded(Device device, const std::vector<T>& values, const char* name) {
    DeviceBuffer<T> buffer(device, values.size(), name);
    buffer.upload(values);
    return buffer;
}

/// main() of a chapter's checks.
inline int checkMain(int argc, char** argv, const std::string& chapter,
                     const std::vector<Check>& checks) {
    return runChecks(argc, argv, chapter, checks, takeReachedHoles);
}

}  // namespace ballpit::check
