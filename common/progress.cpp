// Drawing the bar, and the signal handlers.
#include "common/progress.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace ballpit {

namespace {

volatile std::sig_atomic_t stopReceived = 0;

void noteSignal(int signal) {
    stopReceived = 1;
    std::signal(signal, SIG_DFL);
}

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

StopRequest::StopRequest() {
    stopReceived = 0;
    std::signal(SIGINT, noteSignal);
    std::signal(SIGTERM, noteSignal);
}

StopRequest::~StopRequest() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool StopRequest::received() { return stopReceived != 0; }

Progress::Progress(int frames)
    : frames_(frames),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      drawn_(start_) {}

Progress::~Progress() {
    if (terminal_ && done_ > 0) std::fputc('\n', stderr);
}

void Progress::advance(double stepMilliseconds) {
    ++done_;
    // A running mean: a bar that jumps cannot be read.
    stepMilliseconds_ += (stepMilliseconds - stepMilliseconds_) / (done_ < 20 ? done_ : 20);
    const bool tenth = done_ * 10LL / frames_ != (done_ - 1) * 10LL / frames_;
    const bool due = terminal_ ? secondsSince(drawn_) > 0.1 || done_ == frames_ : tenth;
    if (!due) return;
    drawn_ = std::chrono::steady_clock::now();
    draw();
}

void Progress::draw() const {
    constexpr int width = 30;
    const double share = double(done_) / frames_;
    const double left = secondsSince(start_) / share * (1.0 - share);
    char bar[width + 1] = {};
    for (int k = 0; k < width; ++k) bar[k] = k < share * width ? '#' : '.';
    std::fprintf(stderr, "%s[%s] %d/%d frames  %.2f ms/step  %.0f s left %s", terminal_ ? "\r" : "",
                 bar, done_, frames_, stepMilliseconds_, left, terminal_ ? " " : "\n");
    std::fflush(stderr);
}

}  // namespace ballpit
