// What `./ballpit doctor` cannot see from outside: threads, kernels on the GPU, OpenGL, the video
// encoder. Prints one JSON line a probe, at once: if a driver crashes, the lines before it remain.
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "common/buffer.cuh"
#include "common/device.h"
#include "common/launch.cuh"

#ifdef BALLPIT_GRAPHICS
#include "09_video_recording/video_recorder.h"
#include "common/offscreen_context.h"
#endif

using namespace ballpit;

namespace {

/// "ok", "no" (a chapter cannot be worked through) or "note"; `fix` says what would change it.
struct Finding {
    std::string state, text, fix;
};

void report(const char* probe, const std::function<Finding()>& look) {
    Finding finding;
    try {
        finding = look();
    } catch (const std::exception& error) {
        finding = {"no", error.what(), ""};
    }
    const nlohmann::json line = {
        {"name", probe}, {"state", finding.state}, {"text", finding.text}, {"fix", finding.fix}};
    const auto replace =
        nlohmann::json::error_handler_t::replace;  // drivers' names may be no UTF-8
    std::cout << line.dump(-1, ' ', false, replace) << std::endl;
}

Finding lookAtThreads() {
#ifdef _OPENMP
    return {"ok", std::to_string(cpuThreadCount()) + " for the CPU's loops", ""};
#else
    return {"note", "the CPU's loops run on one thread", "a compiler with OpenMP runs them on all"};
#endif
}

HD inline void writeIndex(int i, View<int> numbers) { numbers[i] = i; }

/// One kernel: fails if the build is for another GPU or the driver is too old.
Finding lookAtKernels() {
    if (!cudaUsable()) return {"note", whyCudaIsUnusable(), ""};
    constexpr int count = 1000;
    DeviceBuffer<int> numbers(Device::cuda, count, "numbers");
    launch<writeIndex>(Device::cuda, count, numbers.view());
    const std::vector<int> written = numbers.download();
    for (int i = 0; i < count; ++i)
        if (written[i] != i) return {"no", "a kernel ran and wrote wrong numbers", ""};
    return {"ok", "a kernel ran on " + describe(Device::cuda), ""};
}

#ifdef BALLPIT_GRAPHICS
/// A few frames, encoded for real: some FFmpeg builds list encoders that do not work.
Finding lookAtVideo() {
    namespace fs = std::filesystem;
    const std::string name = "ballpit_doctor_" + std::to_string(getpid()) + ".mp4";
    const fs::path path = fs::temp_directory_path() / name;
    constexpr int width = 320, height = 180, framesPerSecond = 60;
    VideoRecorder recorder(path.string(), width, height, framesPerSecond);
    Frame frame{width, height, std::vector<std::uint8_t>(3 * width * height, 128)};
    for (int k = 0; k < 5; ++k) recorder.captureFrame(frame);
    recorder.release();
    fs::remove(path);
    const std::string notice = recorder.notice();
    return {notice.empty() ? "ok" : "note", recorder.encoderName() + " encodes", notice};
}
#endif

}  // namespace

int main() {
    report("threads", lookAtThreads);
    report("CUDA", lookAtKernels);
#ifdef BALLPIT_GRAPHICS
    report("graphics", [] { return Finding{"ok", "built in", ""}; });
    report("OpenGL", [] { return Finding{"ok", OffscreenContext().description(), ""}; });
    report("video", lookAtVideo);
#else
    report("graphics", [] {
        return Finding{"no", "this build can neither draw nor record (chapters 08 to 10)",
                       "remove build/cpu-release and build/cuda-release, then call ./ballpit test: "
                       "it installs the libraries"};
    });
#endif
    return 0;
}
