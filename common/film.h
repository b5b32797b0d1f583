// The camera crew of an executable: draws every frame that is wanted and records it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "common/options.h"
#include "common/spheres.h"

namespace ballpit {

/// Draws and records what the options ask for (--out, --png, --stills), as their camera sees it;
/// with none of these, it does nothing and needs no OpenGL. In a build without graphics it refuses
/// them with an InputError.
class Film {
public:
    Film(const Options& options, Bounds world);
    ~Film();
    Film(const Film&) = delete;

    /// True if frames are wanted.
    bool isRolling() const { return crew_ != nullptr; }

    /// The next frame: a picture of balls in body order. With --stills all but the first and the
    /// last of --frames are only counted.
    void capture(const std::vector<Vec3>& positions, const std::vector<float>& radii,
                 const std::vector<Vec3>& colors);

    /// Completes the video, and writes the last picture where --png asked for it.
    void finish();

private:
    struct Crew;
    std::unique_ptr<Crew> crew_;
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
