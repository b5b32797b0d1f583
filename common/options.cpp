// Parsing with CLI11 (the only file that includes it), and the exit codes.
#include "common/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <limits>

#include "common/coloring.h"
#include "common/csv.h"
#include "common/error.h"
#include "common/whole_file.h"

namespace ballpit {

namespace {

void addSharedOptions(CLI::App& app, Options& o, std::string& device) {
    app.add_option("--device", device,
                   "cuda or cpu: the same bits on both; by default the GPU "
                   "where there is one")
        ->check(CLI::IsMember({"cuda", "cpu"}));
    if (app.get_option_no_throw("--response"))
        app.add_option("--count", o.count, "number of balls (default: the scene's own)");
    else
        app.add_option("--count", o.count, "number of balls")->capture_default_str();
    app.add_option("--seed", o.seed, "seed of the scene")->capture_default_str();
    app.add_option("--out", o.out, "video to write (.mp4, .mkv, .mov or .avi)");
    app.add_option("--png", o.png, "picture of the last frame to write");
    app.add_option("--stills", o.stills,
                   "folder for first.png and last.png: only these two frames are drawn");
    app.add_option("--compression", o.compression,
                   "of the video: 0 exact, 51 coarse; six more are half the size")
        ->capture_default_str();
    app.add_option("--yaw", o.shot.yaw,
                   "camera: degrees around the world, 0 in front of it, 90 at its right");
    app.add_option("--pitch", o.shot.pitch, "camera: degrees upwards, 0 level, 90 from above");
    app.add_option("--zoom", o.shot.zoom, "camera: 2 is half as far away")->capture_default_str();
    app.add_option("--orbit", o.shot.orbit, "camera: degrees a second around the world");
    app.add_option("--width", o.width, "pixels of a frame, even")->capture_default_str();
    app.add_option("--height", o.height, "pixels of a frame, even")->capture_default_str();
    app.add_flag("--json", o.json, "print what was found as JSON");
}

void addResponseOptions(CLI::App& app, Options& o) {
    app.add_option("--response", o.response, "how collisions are resolved: " + responseNames())
        ->capture_default_str();
    app.add_option("--iterations", o.knobs.iterations,
                   "detect and resolve rounds a step; with warm and small-steps: passes a substep "
                   "(default: 2, warm 8, small-steps 1)");
    app.add_option("--substeps", o.knobs.substeps,
                   "moves a step, with small-steps (default: 6) or penalty (default: 16)");
    app.add_option("--relaxation", o.knobs.relaxation,
                   "share of each impulse that jacobi uses (default: 1)");
    app.add_option("--restitution-threshold", o.knobs.restitutionThreshold,
                   "m/s below which nothing bounces, with jacobi, coloured (default: 0), warm, "
                   "small-steps (default: what falls in two substeps)");
    app.add_option("--position-share", o.knobs.positionShare,
                   "share of an overlap that a round of jacobi, coloured (default: 1) or warm "
                   "(default: 0.2) takes away");
}

/// What a plan chooses; who gives one of these wants no plan.
constexpr const char* plannedOptions[] = {"--response",    "--iterations",
                                          "--substeps",    "--relaxation",
                                          "--cell-size",   "--restitution-threshold",
                                          "--broad-phase", "--position-share"};

void addPlanOptions(CLI::App& app, Options& o) {
    app.add_option("--plan", o.plan,
                   "auto: the scene's facts choose response, substeps, broad phase, cells and "
                   "steps a frame (default); original: the original design's loop, two rounds of "
                   "mass-split. Any of --response, --iterations, --substeps, --relaxation, "
                   "--restitution-threshold, --position-share, --cell-size and --broad-phase "
                   "switches the plan off")
        ->check(CLI::IsMember({"auto", "original"}));
    app.add_option("--tolerance", o.tolerance,
                   "error that a plan may leave, as a share of a radius or of the energy "
                   "(default: the scene's own, or 0.05)");
    app.add_option_function<std::string>(
           "--broad-phase", [&o](const std::string& name) { o.allPairs = name == "naive"; },
           "grid (default), or naive: all balls with all")
        ->check(CLI::IsMember({"grid", "naive"}));
}

void addSimulationOptions(CLI::App& app, Options& o) {
    app.add_option("--scene", o.scene, sceneNames())->capture_default_str();
    app.add_option("--frames", o.frames, "steps to simulate, one video frame each")
        ->capture_default_str();
    addPlanOptions(app, o);
    addResponseOptions(app, o);
    app.add_option("--dt", o.dt,
                   "time between frames in s, a step's unless planned (default: 1/60)");
    app.add_option("--gravity", o.gravity, "acceleration along y in m/s^2 (default: the scene's)");
    app.add_option("--damping", o.damping, "share of its velocity a ball loses a second");
    app.add_option("--restitution", o.restitution, "for all balls: 0 dead stop, 1 elastic");
    app.add_option("--cell-size", o.cellSize, "edge of a grid cell in m");
    app.add_flag("--periodic", o.periodic,
                 "no walls: what leaves on one side comes in on the other (without gravity; with "
                 "mass-split, racy, atomic, jacobi, coloured)");
    app.add_option("--spheres", o.spheresFile, "CSV of balls to start from");
    app.add_option("--color", o.color,
                   "what colours tell: body, speed, contacts, cell or memory (their order there)")
        ->capture_default_str();
    app.add_option("--save", o.saveFile, "CSV to write the final balls to");
    app.add_flag("--time", o.time,
                 "only measure a step of a pile, of " + std::to_string(o.timedCount) +
                     " balls unless --count says otherwise");
    app.add_flag("--view", o.view,
                 "open a window (H shows its keys); it ends when you close it, or after --frames");
    app.add_flag("--ledger", o.ledger, "draw the figures on recorded frames");
    app.add_flag("--ledger-times", o.ledgerTimes, "the same, with times, which differ each time");
    app.add_flag("--report-state", o.reportState)->group("");  // for tests
}

void addChapterOptions(CLI::App& app, Options& o) {
    if (!o.sceneChoice.empty())
        app.add_option("--scene", o.scene, o.sceneChoice)->capture_default_str();
    app.add_option("--frames", o.frames, "frames of the video")->capture_default_str();
    app.add_flag("--time", o.time,
                 "measure the piece's speed as well, for " + std::to_string(o.timedCount) +
                     " balls unless --count says otherwise");
}

/// How many letters must be changed, added or removed to turn a into b.
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
        }
    }
    return row.back();
}

/// "unknown option --frmaes: did you mean --frames?", or CLI11's own words on one line.
std::string oneLine(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const auto known = [&](const std::string& word) {
            return app.get_option_no_throw(word) != nullptr;
        };
        for (int k = 1; k < argc; ++k) {
            const std::string word = std::string(argv[k]).substr(0, std::string(argv[k]).find('='));
            const bool isOption = word.size() > 1 && word[0] == '-' && !std::isdigit(word[1]);
            if (!isOption || known(word)) continue;
            std::string nearest = "--help";
            for (const CLI::Option* option : app.get_options())
                if (editDistance(word, option->get_name()) < editDistance(word, nearest))
                    nearest = option->get_name();
            return "unknown option " + word + ": did you mean " + nearest + "?";
        }
    }
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text + " (--help shows the options)";
}

/// The number of balls where --count does not say it.
int usualCount(const CLI::App& app, const Options& o) {
    if (o.time) return o.timedCount;
    return app.get_option_no_throw("--response") ? sceneKind(o.scene).usualCount : o.count;
}

/// A plan is made unless something that it chooses was given.
void completePlan(const CLI::App& app, Options& o) {
    const auto given = [&](const char* name) { return app.get_option(name)->count() > 0; };
    const auto* chosen = std::find_if(std::begin(plannedOptions), std::end(plannedOptions), given);
    const bool chooses = chosen == std::end(plannedOptions);
    if (!chooses && given("--plan"))
        throw InputError("--plan " + o.plan + " and " + *chosen +
                         ": a plan chooses that itself; leave one of them out");
    if (chooses && !given("--plan")) o.plan = "auto";
    if (o.tolerance && !o.planned()) throw InputError("--tolerance: only --plan auto has one");
    if (o.tolerance && !(*o.tolerance > 0)) throw InputError("--tolerance: must be above 0");
}

/// What follows from the options that were given, and from those that were not.
void complete(const CLI::App& app, Options& o) {
    const auto given = [&](const char* name) { return app[name]->count() > 0; };
    if (!given("--count")) o.count = usualCount(app, o);
    if (app.get_option_no_throw("--plan")) completePlan(app, o);
    if (o.view && !given("--frames")) {
        o.endless = true;
        o.frames = std::numeric_limits<int>::max();
    }
    if (given("--width")) o.windowWidth = o.width;
    if (given("--height")) o.windowHeight = o.height;
    o.ledger |= o.ledgerTimes;
}

void requireInRange(const Options& o) {
    const auto require = [](bool good, const std::string& message) {
        if (!good) throw InputError(message);
    };
    require(o.count >= 1, "--count " + std::to_string(o.count) + ": at least 1 ball");
    require(o.frames >= 1, "--frames " + std::to_string(o.frames) + ": at least 1");
    if (o.knobs.iterations)
        require(*o.knobs.iterations >= 1,
                "--iterations " + std::to_string(*o.knobs.iterations) + ": at least 1");
    requireSensible(responseMethod(o.response), o.knobs);
    for (const int size : {o.width, o.height})
        require(size >= 16 && size <= 8192 && size % 2 == 0,
                "frame size " + std::to_string(size) + ": an even number from 16 to 8192");
    require(o.compression >= 0 && o.compression <= 51,
            "--compression " + std::to_string(o.compression) + ": 0 to 51");
    require(o.shot.zoom > 0.0f && std::isfinite(o.shot.zoom), "--zoom: must be above 0");
    for (const auto& angle : {o.shot.yaw, o.shot.pitch, o.shot.orbit})
        if (angle) require(std::isfinite(*angle), "--yaw, --pitch, --orbit: finite degrees");
    require(o.stills.empty() || (o.out.empty() && o.png.empty()),
            "--stills draws two frames only: leave out --out and --png, or --stills");
    require(o.stills.empty() || !o.endless,
            "--stills wants the last frame, and a window has none: say how many with --frames");
    coloringNamed(o.color);
    if (o.dt)
        require(*o.dt > 0 && *o.dt <= 1,
                "--dt " + std::to_string(*o.dt) + ": must be above 0, at most 1 s");
    if (o.gravity) require(std::isfinite(*o.gravity), "--gravity: must be a finite number");
    if (o.restitution) {
        const std::string fault = faultOfRestitution(*o.restitution);
        require(fault.empty(), "--restitution: " + fault);
    }
    requireUsable(o.device);
    const std::string still = o.stills.empty() ? "" : firstStill(o.stills);
    for (const std::string& path : {o.out, o.png, o.saveFile, still})
        if (!path.empty()) requireWritable(path);
}

}  // namespace

std::string firstStill(const std::string& folder) { return folder + "/first.png"; }
std::string lastStill(const std::string& folder) { return folder + "/last.png"; }

Scene sceneFor(const Options& o) {
    // With balls of the user's own, the scene still gives the world around them.
    Scene scene =
        makeScene(o.scene, o.spheresFile.empty() ? o.count : sceneKind(o.scene).usualCount, o.seed);
    if (!o.spheresFile.empty()) scene.spheres = readSpheres(o.spheresFile);
    if (o.dt) scene.dt = *o.dt;
    if (o.gravity) scene.gravity = {0, *o.gravity, 0};
    if (o.damping) scene.damping = *o.damping;
    if (o.cellSize) scene.cellSize = *o.cellSize;
    scene.periodic |= o.periodic;
    if (o.restitution)
        std::fill(scene.spheres.restitutions.begin(), scene.spheres.restitutions.end(),
                  *o.restitution);
    return scene;
}

namespace {

int parseAndRun(CLI::App& app, int argc, char** argv, Options& options, std::string& device,
                const std::function<int(const Options&)>& run) {
    addSharedOptions(app, options, device);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        std::cerr << "error: " << oneLine(app, error, argc, argv) << '\n';
        return exitBadInput;
    }
    options.device = device.empty()     ? defaultDevice()
                     : device == "cuda" ? Device::cuda
                                        : Device::cpu;
    return reportingErrors([&] {
        complete(app, options);
        requireInRange(options);
        return run(options);
    });
}

}  // namespace

int runMain(int argc, char** argv, const std::string& purpose, Options options,
            const std::function<int(const Options&)>& run) {
    CLI::App app{purpose};
    std::string device;
    addSimulationOptions(app, options);
    return parseAndRun(app, argc, argv, options, device, run);
}

int runChapter(int argc, char** argv, const std::string& purpose, Options options,
               const std::function<int(const Options&)>& run) {
    CLI::App app{purpose};
    std::string device;
    addChapterOptions(app, options);
    return parseAndRun(app, argc, argv, options, device, run);
}

}  // namespace ballpit
