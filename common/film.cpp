// The film of a build with graphics.
#include "common/film.h"

#include <cstdio>
#include <iostream>
#include <optional>

#include "08_sphere_rendering/sphere_renderer.h"
#include "09_video_recording/video_recorder.h"
#include "common/offscreen_context.h"
#include "common/shared_vertices.h"
#include "common/text.h"
#include "common/timing.h"

namespace ballpit {

namespace {

constexpr int framesPerSecond = 60;

/// How fast frames were made: simulated, drawn, read, encoded and written.
void tellSpeed(const VideoRecorder& recorder, double milliseconds) {
    std::fprintf(stderr, "recorded %d frames in %.2f s: %.1f frames a second, with %s\n",
                 recorder.frameCount(), 1e-3 * milliseconds,
                 1e3 * recorder.frameCount() / milliseconds, recorder.encoderName().c_str());
}

}  // namespace

struct Film::Crew {
    Crew(const FilmOrder& order, Bounds world)
        : renderer(world, order.width, order.height), order(order), world(world) {
        if (!order.video.empty()) {
            recorder.emplace(order.video, order.width, order.height, framesPerSecond,
                             preferredEncoders(), order.compression);
            if (!recorder->notice().empty()) std::cerr << "note: " << recorder->notice() << '\n';
        }
    }
    /// Members go in the reverse order, so all of OpenGL is gone before its context.
    ~Crew() { context.makeCurrent(); }
    Crew(const Crew&) = delete;

    /// With stills, only the first and the last frame are drawn.
    bool isWanted(int number) const {
        return order.stills.empty() || number == 0 || number == order.frames - 1;
    }

    /// One frame: the picture that `draw` draws, text over it, recorded.
    template <class Draw>
    void take(Draw draw, const std::string& text) {
        const int number = frames++;
        if (!isWanted(number)) return;
        context.makeCurrent();
        if (start == 0) start = milliseconds();
        if (!isLooked)
            renderer.camera =
                cameraOf(order.shot, world, static_cast<float>(number) / framesPerSecond);
        draw();
        painter.draw(text, TextPainter::Place::topLeft, order.width, order.height);
        if (recorder) recorder->captureFrame();
        if (!order.stills.empty())
            writePng(number == 0 ? firstStill(order.stills) : lastStill(order.stills),
                     renderer.read());
    }

    OffscreenContext context;
    SphereRenderer renderer;
    TextPainter painter;
    std::optional<VideoRecorder> recorder;
    FilmOrder order;
    Bounds world;
    double start = 0;       // of the first frame, ms
    int frames = 0;         // so far
    bool isLooked = false;  // the camera was placed by hand
};

Film::Film(const FilmOrder& order, Bounds world) {
    if (!order.video.empty() || !order.lastPicture.empty() || !order.stills.empty())
        crew_ = std::make_unique<Crew>(order, world);
}

Film::~Film() {
    if (!vertices_) return;
    crew_->context.makeCurrent();
    vertices_.reset();
}

void Film::look(const Camera& camera, DrawStyle style) {
    crew_->renderer.camera = camera;
    crew_->renderer.style = style;
    crew_->isLooked = true;
}

void Film::capture(const std::vector<Vec3>& positions, const std::vector<float>& radii,
                   const std::vector<Vec3>& colors, const std::string& text) {
    crew_->take([&] { crew_->renderer.draw(positions, radii, colors); }, text);
}

void Film::captureFromBuffer(float largestRadius, const std::vector<Vec3>& colors,
                             const std::string& text) {
    const auto draw = [&] {
        crew_->renderer.setColors(colors);
        crew_->renderer.drawFromBuffer(largestRadius);
    };
    crew_->take(draw, text);
}

SphereRenderer& Film::renderer() {
    crew_->context.makeCurrent();
    return crew_->renderer;
}

void Film::finish() {
    if (!crew_) return;
    crew_->context.makeCurrent();
    if (crew_->recorder) {
        crew_->recorder->release();
        tellSpeed(*crew_->recorder, milliseconds() - crew_->start);
    }
    if (!crew_->order.lastPicture.empty())
        writePng(crew_->order.lastPicture, crew_->renderer.read());
}

}  // namespace ballpit
