// How long each stage of a step took. CUDA events on a GPU, the host's clock on a CPU; on a GPU
// every stage is also an NVTX range, so that profilers show it by name.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "common/device.h"

namespace ballpit {

struct StageTime {
    std::string stage;
    double milliseconds;
};

/// Adds the times of `more` to `sum`, stage by stage.
inline void addStages(std::vector<StageTime>& sum, const std::vector<StageTime>& more) {
    for (const StageTime& time : more) {
        const auto same = std::find_if(sum.begin(), sum.end(), [&](const StageTime& other) {
            return other.stage == time.stage;
        });
        if (same == sum.end())
            sum.push_back(time);
        else
            same->milliseconds += time.milliseconds;
    }
}

/// timer.start("sort"); ...work...; timer.start("reorder"); ...work...; timer.stop().
/// Stages of the same name are added up.
class StageTimer {
public:
    explicit StageTimer(Device device);
    ~StageTimer();
    StageTimer(const StageTimer&) = delete;

    /// A timer that is off costs nothing. Off at first.
    void enable(bool on) { enabled_ = on; }
    bool enabled() const { return enabled_; }

    /// Ends the stage before, if any, and starts this one.
    void start(const char* stage);
    void stop();

    /// Forgets what was timed.
    void clear();

    /// The stages since the last read or clear, in order. Waits for the device.
    std::vector<StageTime> read();

private:
    struct Clock;
    std::unique_ptr<Clock> clock_;
    std::vector<std::string> stages_;
    bool enabled_ = false;
};

}  // namespace ballpit
