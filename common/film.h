// The camera crew of an executable: draws every frame that is wanted and records it.
#pragma once

#include <memory>
#include <string>

#include "08_sphere_rendering/sphere_renderer.h"
#include "common/options.h"
#include "common/spheres.h"

namespace ballpit {

class RigidBodySystem;
class SharedVertices;

/// What a film is to leave behind. Empty paths: nothing of that kind.
struct FilmOrder {
    std::string video, lastPicture;
    int width = 1920, height = 1080;  ///< pixels
};

/// Draws and records what was ordered; if nothing was, it does nothing and needs no OpenGL. Several
/// films may be made in turn on one thread. In a build without graphics every order is refused with
/// an InputError.
class Film {
public:
    Film(const FilmOrder& order, Bounds world);
    /// The order that the options name with --out, --png, --width and --height.
    Film(const Options& options, Bounds world)
        : Film({options.out, options.png, options.width, options.height}, world) {}
    ~Film();
    Film(const Film&) = delete;

    /// True if frames are wanted.
    bool isRolling() const { return crew_ != nullptr; }

    /// How the next frames are drawn. Until then: the whole world, as usual.
    void look(const Camera& camera, DrawStyle style);

    /// Takes a picture of balls in body order, with lines of text over it.
    void capture(const std::vector<Vec3>& positions, const std::vector<float>& radii,
                 const std::vector<Vec3>& colors, const std::string& text = {});

    /// The same of bodies on their device. So many that they are drawn as points go straight to
    /// OpenGL, if the GPU that moves them draws them, too.
    void capture(RigidBodySystem& bodies, const std::vector<float>& radii,
                 const std::vector<Vec3>& colors, const std::string& text = {});

    /// Walks the camera around the world's middle axis, by `degrees` from where it stands.
    void walkAround(float degrees);

    /// Completes the video, and writes the last picture where one was ordered.
    void finish();

private:
    struct Crew;

    SphereRenderer& renderer();
    bool fillsBuffer(RigidBodySystem& bodies);
    void captureFromBuffer(float largestRadius, const std::vector<Vec3>& colors,
                           const std::string& text);

    std::unique_ptr<Crew> crew_;
    std::unique_ptr<SharedVertices> vertices_;
};

/// Shows bodies that do not move: the picture that --png asks for, and for --out a walk around
/// them, --frames long.
void showSpheres(const Options& options, Bounds world, const Spheres& spheres);

}  // namespace ballpit
