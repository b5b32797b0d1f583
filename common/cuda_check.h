// Turns a failed CUDA call into one readable error: the call, its place, CUDA's own words and the
// likely cause. Included only where CUDA's compiler is at work.
#pragma once

#include <cuda_runtime.h>

#include <source_location>

namespace ballpit {

/// Everything runs on this stream: unlike the legacy default stream it can be captured in a graph.
inline const cudaStream_t cudaStream = cudaStreamPerThread;

/// Throws CudaError unless `code` is cudaSuccess. `call` is the call as written.
void checkCuda(cudaError_t code, const char* call,
               std::source_location place = std::source_location::current());

}  // namespace ballpit
