// The command line that all executables share.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/device.h"
#include "common/response_method.h"
#include "common/scene.h"
#include "common/shot.h"

namespace ballpit {

/// What the user asked for; a value not given is left to the scene.
struct Options {
    std::string scene = "gravity_fall";
    std::string sceneChoice;  ///< chapters with a --scene: what it can be
    Device device = Device::cpu;
    int count = 500;
    std::uint64_t seed = 1;
    int frames = 600;
    std::string response = "mass-split";
    ResponseKnobs knobs;              ///< of the response
    bool allPairs = false;            ///< compare all balls with all, without a grid
    std::string plan;                 ///< auto, original, or empty: settings were given
    std::optional<double> tolerance;  ///< of the plan
    /// The scene's facts choose the response and its settings.
    bool planned() const { return plan == "auto"; }
    std::optional<float> dt, gravity, damping, restitution, cellSize;
    bool periodic = false;  ///< without walls
    std::string out;        ///< video to write; empty: none
    std::string png;        ///< picture of the last frame; empty: none
    std::string stills;     ///< folder for the first and the last frame; empty: none
    int compression = 20;   ///< of the video, 0 exact to 51 coarse
    Shot shot;              ///< where the camera stands, how it moves
    /// Frames in motion are wanted, more than one picture.
    bool isFilmed() const { return !out.empty() || !stills.empty(); }
    std::string color = "body";       ///< what a ball's colour tells (simulations)
    std::string spheresFile;          ///< CSV to start from instead of the scene's bodies
    std::string saveFile;             ///< CSV to write at the end
    int width = 1920, height = 1080;  ///< of frames, pixels
    bool ledger = false;              ///< figures drawn on frames
    bool ledgerTimes = false;         ///< times among them
    bool view = false;                ///< a window
    bool endless = false;             ///< no limit to the steps: a window without --frames
    int windowWidth = 1280, windowHeight = 720;  ///< at first, pixels
    bool reportState = false;                    ///< the window tells tests what it shows
    bool json = false;                           ///< the summary as JSON
    bool time = false;                           ///< measure speed (chapters)
    int timedCount = 200'000;                    ///< balls with --time, where --count is not given
};

/// The scene that the options describe: made by name or read from the CSV, then changed by the
/// values that were given. InputError where that cannot be.
Scene sceneFor(const Options& options);

/// The two pictures that --stills FOLDER asks for.
std::string firstStill(const std::string& folder);
std::string lastStill(const std::string& folder);

/// Everything a main needs: parses the command line on top of `defaults`, checks the output paths,
/// calls `run`, and turns errors into one line on stderr and an exit code (common/error.h).
int runMain(int argc, char** argv, const std::string& purpose, Options defaults,
            const std::function<int(const Options&)>& run);

/// The same for the executable of a chapter on one piece: it knows only the options that make
/// sense there (device, count, seed, picture, video, JSON, --time).
int runChapter(int argc, char** argv, const std::string& purpose, Options defaults,
               const std::function<int(const Options&)>& run);

}  // namespace ballpit
