// The film of a build with graphics.
#include "common/film.h"

#include <cmath>
#include <iostream>
#include <optional>

#include "08_sphere_rendering/sphere_renderer.h"
#include "09_video_recording/video_recorder.h"
#include "common/offscreen_context.h"
#include "common/text.h"

namespace ballpit {

namespace {

constexpr int framesPerSecond = 60;

}  // namespace

struct Film::Crew {
    Crew(const FilmOrder& order, Bounds world)
        : renderer(world, order.width, order.height), order(order) {
        if (!order.video.empty()) {
            recorder.emplace(order.video, order.width, order.height, framesPerSecond);
            if (!recorder->notice().empty()) std::cerr << "note: " << recorder->notice() << '\n';
        }
    }
    /// Members go in the reverse order, so all of OpenGL is gone before its context.
    ~Crew() { context.makeCurrent(); }
    Crew(const Crew&) = delete;

    OffscreenContext context;
    SphereRenderer renderer;
    TextPainter painter;
    std::optional<VideoRecorder> recorder;
    FilmOrder order;
    Frame last;
};

Film::Film(const FilmOrder& order, Bounds world) {
    if (!order.video.empty() || !order.lastPicture.empty())
        crew_ = std::make_unique<Crew>(order, world);
}

Film::~Film() = default;

void Film::look(const Camera& camera, DrawStyle style) {
    crew_->renderer.camera = camera;
    crew_->renderer.style = style;
}

void Film::capture(const std::vector<Vec3>& positions, const std::vector<float>& radii,
                   const std::vector<Vec3>& colors, const std::string& text) {
    crew_->context.makeCurrent();
    crew_->renderer.draw(positions, radii, colors);
    crew_->painter.draw(text, TextPainter::Place::topLeft, crew_->order.width, crew_->order.height);
    crew_->last = crew_->renderer.read();
    if (crew_->recorder) crew_->recorder->captureFrame(crew_->last);
}

void Film::walkAround(float degrees) {
    Camera& camera = crew_->renderer.camera;
    const float angle = degrees * 3.14159265f / 180.0f;
    const Vec3 arm = camera.eye - camera.target;
    camera.eye = camera.target + Vec3{std::cos(angle) * arm.x + std::sin(angle) * arm.z, arm.y,
                                      std::cos(angle) * arm.z - std::sin(angle) * arm.x};
}

void Film::finish() {
    if (!crew_) return;
    crew_->context.makeCurrent();
    if (crew_->recorder) crew_->recorder->release();
    if (!crew_->order.lastPicture.empty()) writePng(crew_->order.lastPicture, crew_->last);
}

}  // namespace ballpit
