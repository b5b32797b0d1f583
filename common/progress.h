// A progress bar on stderr, and Ctrl-C as a polite request to stop.
#pragma once

#include <chrono>
#include <string>

namespace ballpit {

/// From its construction on, Ctrl-C and SIGTERM no longer kill the program but are noted, so that a
/// recording can be completed. A second Ctrl-C kills it as usual.
class StopRequest {
public:
    StopRequest();
    ~StopRequest();
    StopRequest(const StopRequest&) = delete;
    static bool received();
};

/// Frames done, milliseconds a step, time left. A bar that is redrawn on a terminal; a line for
/// every tenth elsewhere.
class Progress {
public:
    explicit Progress(int frames);
    ~Progress();
    Progress(const Progress&) = delete;

    /// One more frame is done; its step took `stepMilliseconds`.
    void advance(double stepMilliseconds);

private:
    void draw() const;

    int frames_, done_ = 0;
    double stepMilliseconds_ = 0.0;
    bool terminal_;
    std::chrono::steady_clock::time_point start_, drawn_;
};

}  // namespace ballpit
