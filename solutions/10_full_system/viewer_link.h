// What passes between the simulation's thread and the window's: pictures one way, wishes the other.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "08_sphere_rendering/sphere_renderer.h"
#include "10_full_system/handover.h"
#include "10_full_system/ledger.h"
#include "common/coloring.h"

namespace ballpit {

/// What a window shows of one state.
struct Snapshot {
    std::vector<Vec3> positions, colors;
    Ledger ledger;
    ColorBy colorBy = ColorBy::body;
    bool paused = false;
    bool finished = false;  ///< there will be no more steps
    std::string recording;  ///< the video being recorded; empty: none
    std::string message;    ///< the last thing worth telling about a recording
};

/// What the user asks for in the window.
struct Wishes {
    bool stop = false, paused = false;
    long singleSteps = 0;  ///< asked for since the start
    bool ledger = true;    ///< its figures are wanted
    ColorBy colorBy = ColorBy::body;
    bool recording = false;
    // What a recording shows: the window's own view.
    Camera camera;
    DrawStyle style;
    int width = 0, height = 0;  ///< pixels
};

/// Wishes, on their way from the window to the simulation.
class RemoteControl {
public:
    using Clock = std::chrono::steady_clock;

    template <class Change>
    void change(Change change) {
        {
            const std::lock_guard lock(mutex_);
            change(wishes_);
            changed_ = true;
        }
        signal_.notify_one();
    }

    Wishes wishes() const {
        const std::lock_guard lock(mutex_);
        return wishes_;
    }

    /// The wishes, once they change, or at that moment at the latest. For one thread alone.
    Wishes awaitChange(Clock::time_point latest) {
        std::unique_lock lock(mutex_);
        signal_.wait_until(lock, latest, [this] { return changed_; });
        changed_ = false;
        return wishes_;
    }

private:
    mutable std::mutex mutex_;
    std::condition_variable signal_;
    Wishes wishes_;
    bool changed_ = false;
};

struct ViewerLink {
    Handover<Snapshot> snapshots;
    RemoteControl remote;
};

}  // namespace ballpit
