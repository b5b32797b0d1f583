// The film of a build with graphics.
#include "common/film.h"

#include <iostream>
#include <optional>

#include "08_sphere_rendering/sphere_renderer.h"
#include "09_video_recording/video_recorder.h"
#include "common/offscreen_context.h"

namespace ballpit {

namespace {

constexpr int framesPerSecond = 60;

}  // namespace

struct Film::Crew {
    Crew(const Options& options, Bounds world)
        : options(options), world(world), renderer(world, options.width, options.height) {
        if (!options.out.empty()) {
            recorder.emplace(options.out, options.width, options.height, framesPerSecond);
            if (!recorder->notice().empty()) std::cerr << "note: " << recorder->notice() << '\n';
        }
    }

    /// Must a frame be drawn, and is it one that --stills asks for?
    bool isStill() const {
        return !options.stills.empty() && (frames == 0 || frames == options.frames - 1);
    }
    bool isWanted() const { return options.stills.empty() || isStill(); }

    Options options;
    Bounds world;
    int frames = 0;  // so far
    OffscreenContext context;
    SphereRenderer renderer;
    std::optional<VideoRecorder> recorder;
    Frame last;
};

Film::Film(const Options& options, Bounds world) {
    if (!options.out.empty() || !options.png.empty() || !options.stills.empty())
        crew_ = std::make_unique<Crew>(options, world);
}

Film::~Film() = default;

void Film::capture(const std::vector<Vec3>& positions, const std::vector<float>& radii,
                   const std::vector<Vec3>& colors) {
    Crew& crew = *crew_;
    if (crew.isWanted()) {
        const float seconds = static_cast<float>(crew.frames) / framesPerSecond;
        crew.renderer.camera = cameraOf(crew.options.shot, crew.world, seconds);
        crew.renderer.draw(positions, radii, colors);
        crew.last = crew.renderer.read();
        if (crew.recorder) crew.recorder->captureFrame(crew.last);
        const std::string& stills = crew.options.stills;
        if (crew.isStill())
            writePng(crew.frames == 0 ? firstStill(stills) : lastStill(stills), crew.last);
    }
    ++crew.frames;
}

void Film::finish() {
    if (!crew_) return;
    if (crew_->recorder) crew_->recorder->release();
    if (!crew_->options.png.empty()) writePng(crew_->options.png, crew_->last);
}

}  // namespace ballpit
