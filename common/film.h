// The camera crew of an executable: draws every frame that is wanted and records it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "08_sphere_rendering/sphere_renderer.h"
#include "common/options.h"
#include "common/spheres.h"

namespace ballpit {

class RigidBodySystem;
class SharedVertices;

/// What a film is to leave behind, and its camera. Empty paths: nothing of that kind.
struct FilmOrder {
    std::string video, lastPicture;
    int width = 1920, height = 1080;  ///< pixels
    std::string stills;               ///< folder; then only two frames are drawn
    int frames = 0;                   ///< with stills: the film's length, so which is the last
    Shot shot;
    int compression = 20;  ///< of the video, 0 exact to 51 coarse
};

/// Draws and records what was ordered; if nothing was, it does nothing and needs no OpenGL. Several
/// films may be made in turn on one thread. In a build without graphics every order is refused with
/// an InputError.
class Film {
public:
    Film(const FilmOrder& order, Bounds world);
    /// The order that the options name with --out, --png, --stills, --width, --height and those of
    /// the camera.
    Film(const Options& o, Bounds world)
        : Film({o.out, o.png, o.width, o.height, o.stills, o.frames, o.shot, o.compression},
               world) {}
    ~Film();
    Film(const Film&) = delete;

    /// True if frames are wanted.
    bool isRolling() const { return crew_ != nullptr; }

    /// How the next frames are drawn. Until then: as the order's shot says.
    void look(const Camera& camera, DrawStyle style);

    /// The next frame: balls in body order, with lines of text over them.
    void capture(const std::vector<Vec3>& positions, const std::vector<float>& radii,
                 const std::vector<Vec3>& colors, const std::string& text = {});

    /// The same of bodies on their device. So many that they are drawn as points go straight to
    /// OpenGL, if the GPU that moves them draws them, too.
    void capture(RigidBodySystem& bodies, const std::vector<float>& radii,
                 const std::vector<Vec3>& colors, const std::string& text = {});

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

/// Shows bodies that do not move: the picture that --png asks for, and for a video a walk around
/// them, --frames long.
void showSpheres(const Options& options, Bounds world, const Spheres& spheres);

/// Shows bodies in motion: `look` changes and colours them for each frame. `share` of the film is
/// over, 0 for the first frame, 1 for the last. A picture alone (--png) shows share `stillShare`.
void showMotion(const Options& options, Bounds world, Spheres spheres,
                const std::function<void(Spheres& spheres, float share)>& look,
                float stillShare = 0.0f);

}  // namespace ballpit
