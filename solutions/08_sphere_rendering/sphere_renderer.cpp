// The passes that make a picture: shade, background, floor, balls, lines.
#include "08_sphere_rendering/sphere_renderer.h"

#include "08_sphere_rendering/ball_shapes.h"
#include "08_sphere_rendering/render_target.h"
#include "08_sphere_rendering/stage.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>

namespace ballpit {
namespace {

/// Up to this many balls the automatic choice sorts them and gives them soft edges; beyond, a ball
/// is a few pixels wide, and sorting and expanding squares on the CPU costs more than the picture.
constexpr std::size_t softEdgeLimit = 20'000;

/// The balls with these numbers.
struct Chosen {
    std::vector<Vec3> positions, colors;
    std::vector<float> radii;

    Chosen(const Balls& balls, const std::vector<std::size_t>& numbers) {
        for (const std::size_t i : numbers) {
            positions.push_back(balls.positions[i]);
            radii.push_back(balls.radii[i]);
            colors.push_back(balls.colors[i]);
        }
    }
    Balls balls() const { return {positions, radii, colors}; }
};

}  // namespace

struct SphereRenderer::Parts {
    explicit Parts(Bounds world) : stage(world) {}

    Stage stage;
    BallQuads quads;
    BallPoints points;
    BallMeshes meshes;
    std::unique_ptr<RenderTarget> target;
    std::optional<Sight> sight;  // of the picture being drawn
};

SphereRenderer::SphereRenderer(Bounds world, int width, int height)
    : camera(frameWorld(world)), world_(world) {
    parts_ = std::make_unique<Parts>(world);
    resize(width, height);
}

SphereRenderer::~SphereRenderer() = default;

void SphereRenderer::resize(int width, int height) {
    if (width == width_ && height == height_) return;
    parts_->target = std::make_unique<RenderTarget>(width, height);  // or throws: all stays
    width_ = width;
    height_ = height;
}

unsigned SphereRenderer::framebuffer() const { return parts_->target->name(); }

BallShape SphereRenderer::shapeFor(std::size_t count) const {
    if (style.wireframe) return BallShape::gluSpheres;
    if (style.shape != BallShape::automatic) return style.shape;
    return count <= softEdgeLimit ? BallShape::impostors : BallShape::points;
}

void SphereRenderer::draw(std::span<const Vec3> positions, std::span<const float> radii,
                          std::span<const Vec3> colors) {
    if (radii.size() != positions.size() || colors.size() != positions.size())
        throw std::invalid_argument("draw: positions, radii and colors differ in number");
    const Balls balls{positions, radii, colors};
    parts_->sight.emplace(camera, world_, width_, height_);
    const BallShape shape = shapeFor(balls.count());
    if (shape == BallShape::points) return drawAsPoints(balls);
    parts_->quads.take(balls, *parts_->sight, true);
    if (style.world) parts_->stage.shade(parts_->quads);
    beginFrame();
    if (shape == BallShape::gluSpheres)
        parts_->meshes.draw(balls, *parts_->sight, style.slices, style.wireframe);
    else
        parts_->quads.draw(*parts_->sight);
    endFrame();
}

void SphereRenderer::drawPoints() {
    if (style.world) parts_->stage.shade(parts_->points);
    beginFrame();
    parts_->points.draw(*parts_->sight);
    parts_->quads.draw(*parts_->sight);
    endFrame();
}

unsigned SphereRenderer::positionBuffer(std::size_t count) { return parts_->points.reserve(count); }

void SphereRenderer::setColors(std::span<const Vec3> colors) { parts_->points.setColors(colors); }

void SphereRenderer::drawFromBuffer(float largestRadius) {
    parts_->sight.emplace(camera, world_, width_, height_);
    parts_->points.takeOpenBuffer();
    // The largest that a ball can appear: at the end of the world that is nearest to the eye.
    const Vec3 forward = axesOf(camera).forward, half = 0.5f * extent(world_);
    const float reach =
        half.x * std::abs(forward.x) + half.y * std::abs(forward.y) + half.z * std::abs(forward.z);
    const Vec3 nearEnd = 0.5f * (world_.lower + world_.upper) - reach * forward;
    if (!parts_->points.isTooLarge(parts_->sight->pixelRadius(nearEnd, largestRadius))) {
        parts_->quads.take({}, *parts_->sight, false);
        return drawPoints();
    }
    std::vector<Vec3> positions;
    std::vector<float> radii;
    for (const Vec4 ball : parts_->points.fetch()) {
        positions.push_back(xyz(ball));
        radii.push_back(ball.w);
    }
    drawAsPoints({positions, radii, parts_->points.colors()});
}

/// What is too large for a point becomes a square; unsorted like the points.
void SphereRenderer::drawAsPoints(const Balls& balls) {
    const Chosen large(balls, parts_->points.take(balls, *parts_->sight));
    parts_->quads.take(large.balls(), *parts_->sight, false);
    drawPoints();
}

/// Binds the frame and draws what lies behind the balls.
void SphereRenderer::beginFrame() {
    parts_->target->bind();
    parts_->sight->loadMatrices();
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    glDepthMask(GL_TRUE);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    if (style.world) parts_->stage.drawBackground();
    useDepthTest();
    if (style.world) parts_->stage.drawFloor(style.floorGrid);
}

/// Draws what lies over the balls.
void SphereRenderer::endFrame() {
    glDepthMask(GL_FALSE);
    if (style.world) parts_->stage.drawLines();
    glPopAttrib();
}

void SphereRenderer::finish() { glFinish(); }

Frame SphereRenderer::read() {
    const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
    rgba_.resize(4 * width * height);
    parts_->target->bind();
    // Four bytes a pixel are a plain copy in every driver; three are converted slowly.
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());

    Frame frame{width_, height_, std::vector<std::uint8_t>(3 * width * height)};
    for (std::size_t row = 0; row < height; ++row) {
        // OpenGL's first row is the bottom one.
        const std::uint8_t* from = rgba_.data() + 4 * width * (height - 1 - row);
        std::uint8_t* to = frame.rgb.data() + 3 * width * row;
        for (std::size_t i = 0; i < width; ++i)
            for (std::size_t channel = 0; channel < 3; ++channel)
                to[3 * i + channel] = from[4 * i + channel];
    }
    return frame;
}

}  // namespace ballpit
