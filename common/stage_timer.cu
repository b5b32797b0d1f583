// The timer's two clocks.
#include "common/stage_timer.h"

#include <chrono>

#ifdef BALLPIT_CUDA
#include <nvtx3/nvToolsExt.h>

#include "common/cuda_check.h"
#endif

namespace ballpit {

/// Points in time: on a GPU events in the stream, on a CPU readings of the clock.
struct StageTimer::Clock {
    explicit Clock(Device device) : device(device) {}

    void stamp(std::size_t k) {
#ifdef BALLPIT_CUDA
        if (device == Device::cuda) return stampOnStream(k);
#endif
        readings.resize(k + 1);
        readings[k] = std::chrono::steady_clock::now();
    }

    double millisecondsBefore(std::size_t k) {
#ifdef BALLPIT_CUDA
        if (device == Device::cuda) {
            float milliseconds = 0.0f;
            checkCuda(cudaEventElapsedTime(&milliseconds, events[k - 1], events[k]),
                      "cudaEventElapsedTime");
            return milliseconds;
        }
#endif
        return std::chrono::duration<double, std::milli>(readings[k] - readings[k - 1]).count();
    }

#ifdef BALLPIT_CUDA
    ~Clock() {
        for (cudaEvent_t event : events) cudaEventDestroy(event);
    }

    void stampOnStream(std::size_t k) {
        while (events.size() <= k) {
            events.emplace_back();
            checkCuda(cudaEventCreate(&events.back()), "cudaEventCreate");
        }
        checkCuda(cudaEventRecord(events[k], cudaStream), "cudaEventRecord");
    }
    std::vector<cudaEvent_t> events;
#endif

    Device device;
    std::vector<std::chrono::steady_clock::time_point> readings;
};

namespace {

#ifdef BALLPIT_CUDA
void beginRange(const char* stage) { nvtxRangePushA(stage); }
void endRange() { nvtxRangePop(); }  // without a range to end, NVTX does nothing
#else
void beginRange(const char*) {}
void endRange() {}
#endif

}  // namespace

StageTimer::StageTimer(Device device) : clock_(std::make_unique<Clock>(device)) {}
StageTimer::~StageTimer() = default;

void StageTimer::start(const char* stage) {
    if (!enabled_) return;
    clock_->stamp(stages_.size());
    endRange();
    beginRange(stage);
    stages_.emplace_back(stage);
}

void StageTimer::stop() {
    if (!enabled_) return;
    clock_->stamp(stages_.size());
    endRange();
}

void StageTimer::clear() { stages_.clear(); }

std::vector<StageTime> StageTimer::read() {
    synchronize(clock_->device);
    std::vector<StageTime> times;
    for (std::size_t k = 0; k < stages_.size(); ++k) {
        const double milliseconds = clock_->millisecondsBefore(k + 1);
        auto same = times.begin();
        while (same != times.end() && same->stage != stages_[k]) ++same;
        if (same == times.end())
            times.push_back({stages_[k], milliseconds});
        else
            same->milliseconds += milliseconds;
    }
    stages_.clear();
    return times;
}

}  // namespace ballpit
