// Starting, failing and finishing.
#include "10_full_system/user_recording.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>

namespace ballpit {

template <class Work>
void UserRecording::attempt(Work work) {
    try {
        work();
    } catch (const std::exception& error) {
        film_.reset();
        message_ = std::string("not recorded: ") + error.what();
        std::cerr << "error: " << message_ << '\n';
    }
}

void UserRecording::start(int width, int height) {
    attempt([&] {
        path_ = freePath();
        const auto even = [](int size) { return std::max(2, size - size % 2); };
        film_ = std::make_unique<Film>(FilmOrder{path_, "", even(width), even(height)}, world_);
        frames_ = 0;
        message_ = "recording " + path_;
    });
}

void UserRecording::capture(const Camera& camera, DrawStyle style,
                            const std::vector<Vec3>& positions, const std::vector<float>& radii,
                            const std::vector<Vec3>& colors, const std::string& text) {
    attempt([&] {
        film_->look(camera, style);
        film_->capture(positions, radii, colors, text);
        ++frames_;
    });
}

void UserRecording::finish() {
    if (!isRunning()) return;
    attempt([&] {
        if (frames_ > 0) film_->finish();
        film_.reset();
        message_ = frames_ > 0 ? "saved " + path_ + " (" + std::to_string(frames_) + " frames)"
                               : "nothing recorded: no step was made";
    });
}

/// The first number that is free.
std::string UserRecording::freePath() const {
    std::filesystem::create_directories("videos");
    for (int number = 1;; ++number) {
        std::array<char, 16> digits{};
        std::snprintf(digits.data(), digits.size(), "%03d", number);
        std::string path = "videos/" + name_ + "_" + digits.data() + ".mp4";
        if (!std::filesystem::exists(path)) return path;
    }
}

}  // namespace ballpit
