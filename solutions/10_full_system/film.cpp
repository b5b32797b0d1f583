// The film of a build with graphics.
#include "10_full_system/film.h"

#include <iostream>
#include <optional>

#include "08_sphere_rendering/sphere_renderer.h"
#include "09_video_recording/video_recorder.h"
#include "common/offscreen_context.h"

namespace ballpit {

namespace {

constexpr int frameWidth = 1920, frameHeight = 1080, framesPerSecond = 60;

}  // namespace

struct Film::Crew {
    Crew(const Options& options, Bounds world)
        : renderer(world, frameWidth, frameHeight), png(options.png) {
        if (!options.out.empty()) {
            recorder.emplace(options.out, frameWidth, frameHeight, framesPerSecond);
            if (!recorder->notice().empty()) std::cerr << "note: " << recorder->notice() << '\n';
        }
    }

    OffscreenContext context;
    SphereRenderer renderer;
    std::optional<VideoRecorder> recorder;
    std::string png;
    Frame last;
};

Film::Film(const Options& options, Bounds world) {
    if (!options.out.empty() || !options.png.empty())
        crew_ = std::make_unique<Crew>(options, world);
}

Film::~Film() = default;

void Film::capture(const std::vector<Vec3>& positions, const std::vector<float>& radii,
                   const std::vector<Vec3>& colors) {
    crew_->renderer.draw(positions, radii, colors);
    crew_->last = crew_->renderer.read();
    if (crew_->recorder) crew_->recorder->captureFrame(crew_->last);
}

void Film::finish() {
    if (!crew_) return;
    if (crew_->recorder) crew_->recorder->release();
    if (!crew_->png.empty()) writePng(crew_->png, crew_->last);
}

}  // namespace ballpit
