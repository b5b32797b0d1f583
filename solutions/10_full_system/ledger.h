// The ledger: what is told about a running simulation, in a window and on recorded frames.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/metrics.h"
#include "common/stage_timer.h"

namespace ballpit {

/// What the host must measure on a downloaded state. That costs time, so it is not done every step.
struct MeasuredFigures {
    long step = -1;  ///< of the state that was measured; -1: nothing yet
    Metrics metrics;
    std::uint64_t hash = 0;
};

struct Ledger {
    std::string scene;
    std::size_t balls = 0;
    long step = 0;
    double seconds = 0.0;           ///< simulated
    std::size_t contacts = 0;       ///< touching pairs in the last step
    double stepMilliseconds = 0.0;  ///< running mean
    std::vector<StageTime> stages;  ///< of the last step that was timed
    MeasuredFigures figures;
};

/// The ledger as lines. Without `withTimes` nothing in it depends on the machine or on the moment,
/// so that the same recording has the same pictures.
std::string ledgerText(const Ledger& ledger, bool withTimes,
                       std::optional<double> framesPerSecond = {});

/// On recorded frames, figures are measured every step, or from 20 000 balls on four times a second
/// of the video. It must not depend on how fast the machine is.
bool recordingMeasures(long step, std::size_t balls);

/// In a window, figures are measured up to four times a second, but never for more than a tenth of
/// the time.
class MeasuringRhythm {
public:
    using Clock = std::chrono::steady_clock;

    bool isDue(Clock::time_point now) const { return now >= next_; }
    void measured(Clock::time_point start, Clock::time_point end);

private:
    Clock::time_point next_{};
};

}  // namespace ballpit
