// The executable's clip: balls that hop on the floor and know nothing of each other.
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "00_hello_spheres/hello_spheres.cuh"
#include "08_sphere_rendering/sphere_renderer.h"
#include "09_video_recording/video_recorder.h"
#include "common/launch.cuh"
#include "common/offscreen_context.h"
#include "common/options.h"
#include "common/spheres.h"

namespace ballpit {

constexpr int clipRate = 60;  ///< frames a second

/// Chapter 00's hill; every ball hops from its place and comes back to it.
class HoppingBalls {
public:
    HoppingBalls(int count, std::uint64_t seed) {
        DeviceBuffer<Vec4> onDevice(Device::cpu, static_cast<std::size_t>(count), "positions");
        DeviceBuffer<Vec3> colorsThere(Device::cpu, static_cast<std::size_t>(count), "colors");
        launch<placeBall>(Device::cpu, count, makeHill(count, seed), onDevice.view(),
                          colorsThere.view());
        const std::vector<Vec4> places = onDevice.download();
        const std::vector<Vec3> colors = colorsThere.download();
        for (std::size_t k = 0; k < places.size(); ++k)
            start_.add(xyz(places[k]), {0, 0, 0}, places[k].w, 1, 1, colors[k]);
    }

    Bounds world() const { return {{-5, 0, -5}, {5, 6, 5}}; }

    /// The balls at frame `number`: each hops for 0.6 to 1.1 s, again and again.
    Spheres at(int number) const {
        Spheres balls = start_;
        constexpr float g = 9.81f;  // m/s^2
        for (std::size_t k = 0; k < balls.count(); ++k) {
            const float duration = 0.6f + 0.1f * static_cast<float>(k % 6);
            const float hops = static_cast<float>(number) / clipRate / duration;
            const float time = duration * (hops - std::floor(hops));
            balls.positions[k].y += 0.5f * g * time * (duration - time);
        }
        return balls;
    }

private:
    Spheres start_;
};

/// Draws the clip's frames, one after the other.
class Studio {
public:
    Studio(const HoppingBalls& balls, int width, int height)
        : balls_(balls), renderer_(balls.world(), width, height) {}

    void draw(int number) {
        const Spheres now = balls_.at(number);
        renderer_.draw(now.positions, now.radii, now.colors);
    }

    Frame read() { return renderer_.read(); }

private:
    OffscreenContext context_;
    const HoppingBalls& balls_;
    SphereRenderer renderer_;
};

/// Records the clip; the name of the encoder that did.
inline std::string recordClip(const HoppingBalls& balls, const std::string& path, int frames,
                              int width, int height) {
    Studio studio(balls, width, height);
    VideoRecorder recorder(path, width, height, clipRate);
    for (int number = 0; number < frames; ++number) {
        studio.draw(number);
        recorder.captureFrame();
    }
    recorder.release();
    return recorder.encoderName();
}

/// The first and the last frame of the clip, as pictures: what --stills asks for.
inline void keepStills(const HoppingBalls& balls, const Options& o) {
    Studio studio(balls, o.width, o.height);
    studio.draw(0);
    writePng(firstStill(o.stills), studio.read());
    studio.draw(o.frames - 1);
    writePng(lastStill(o.stills), studio.read());
}

/// A file of the options' name, or one that is gone at the end.
struct ClipFile {
    explicit ClipFile(const std::string& asked) : path(asked), isTemporary(asked.empty()) {
        const std::string name = "ballpit_clip_" + std::to_string(getpid()) + ".mp4";
        if (isTemporary) path = (std::filesystem::temp_directory_path() / name).string();
    }
    ~ClipFile() {
        std::error_code ignored;
        if (isTemporary) std::filesystem::remove(path, ignored);
    }
    std::string path;
    bool isTemporary;
};

}  // namespace ballpit
