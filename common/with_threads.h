// Turns the number of the CPU's threads for a scope.
#pragma once

#ifdef _OPENMP
#include <omp.h>
#endif

namespace ballpit {

/// Runs a scope on so many threads.
class WithThreads {
public:
#ifdef _OPENMP
    explicit WithThreads(int threads) : before_(omp_get_max_threads()) {
        omp_set_num_threads(threads);
    }
    ~WithThreads() { omp_set_num_threads(before_); }

private:
    int before_;
#else
    explicit WithThreads(int) {}
#endif
};

}  // namespace ballpit
