// The camera crew of an executable: draws every frame that is wanted and records it.
#pragma once

#include <memory>
#include <string>

#include "common/options.h"
#include "common/spheres.h"

namespace ballpit {

/// Draws and records what the options ask for (--out, --png); with neither, it does nothing and
/// needs no OpenGL. In a build without graphics it refuses both with an InputError.
class Film {
public:
    Film(const Options& options, Bounds world);
    ~Film();
    Film(const Film&) = delete;

    /// True if frames are wanted.
    bool isRolling() const { return crew_ != nullptr; }

    /// Takes a picture of balls in body order.
    void capture(const std::vector<Vec3>& positions, const std::vector<float>& radii,
                 const std::vector<Vec3>& colors);

    /// Walks the camera around the world's middle axis, by `degrees` from where it stands.
    void walkAround(float degrees);

    /// Completes the video, and writes the last picture where --png asked for it.
    void finish();

private:
    struct Crew;
    std::unique_ptr<Crew> crew_;
};

/// Shows bodies that do not move: the picture that --png asks for, and for --out a walk around
/// them, --frames long.
void showSpheres(const Options& options, Bounds world, const Spheres& spheres);

}  // namespace ballpit
