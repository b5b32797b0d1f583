// A recorded sequence of launches that can be repeated in one call: a CUDA graph. Small scenes
// spend more time launching kernels than running them; a graph launches all of a step at once.
#pragma once

#ifdef __CUDACC__
#include "common/cuda_check.h"
#endif

namespace ballpit {

#ifdef __CUDACC__

class LaunchRecording {
public:
    LaunchRecording() = default;
    LaunchRecording(const LaunchRecording&) = delete;
    ~LaunchRecording() {
        if (graph_) cudaGraphExecDestroy(graph_);
    }

    /// Calls `enqueue` once without running what it launches, and keeps the launches. It must not
    /// allocate memory or wait for the device.
    template <class Enqueue>
    void record(Enqueue enqueue) {
        checkCuda(cudaStreamBeginCapture(cudaStream, cudaStreamCaptureModeThreadLocal),
                  "cudaStreamBeginCapture");
        enqueue();
        cudaGraph_t graph = nullptr;
        checkCuda(cudaStreamEndCapture(cudaStream, &graph), "cudaStreamEndCapture");
        const cudaError_t result = cudaGraphInstantiate(&graph_, graph, 0);
        cudaGraphDestroy(graph);
        checkCuda(result, "cudaGraphInstantiate");
    }

    /// Runs the recorded launches.
    void replay() { checkCuda(cudaGraphLaunch(graph_, cudaStream), "cudaGraphLaunch"); }

private:
    cudaGraphExec_t graph_ = nullptr;
};

#else

/// Without CUDA nothing is ever recorded.
class LaunchRecording {
public:
    template <class Enqueue>
    void record(Enqueue) {}
    void replay() {}
};

#endif

}  // namespace ballpit
