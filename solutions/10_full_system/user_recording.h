// What the user records in the window: its view, one frame a step.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/film.h"

namespace ballpit {

/// A recording that is started and stopped at will, each time into a new file. One that fails says
/// so and ends; it throws nothing, since the simulation is to go on.
class UserRecording {
public:
    /// Files are called videos/`name`_001.mp4 and so on, below the current folder.
    UserRecording(Bounds world, std::string name) : world_(world), name_(std::move(name)) {}

    /// With frames of this size, or one pixel less where it is odd.
    void start(int width, int height);
    void capture(const Camera& camera, DrawStyle style, const std::vector<Vec3>& positions,
                 const std::vector<float>& radii, const std::vector<Vec3>& colors,
                 const std::string& text);
    /// Completes the file.
    void finish();

    bool isRunning() const { return film_ != nullptr; }

    /// The file that is being recorded; empty if none is.
    std::string path() const { return isRunning() ? path_ : ""; }

    /// The last thing worth telling, as "saved videos/gravity_fall_001.mp4 (62 frames)".
    const std::string& message() const { return message_; }

private:
    template <class Work>
    void attempt(Work work);
    std::string freePath() const;

    Bounds world_;
    std::string name_, path_, message_;
    std::unique_ptr<Film> film_;
    int frames_ = 0;
};

}  // namespace ballpit
