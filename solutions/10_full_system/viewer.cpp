// The window's side: keys become wishes, snapshots become pictures.
#include "10_full_system/viewer.h"

#include <atomic>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "10_full_system/opengl_visualizer.h"
#include "common/progress.h"

namespace ballpit {
namespace {

using Clock = std::chrono::steady_clock;

/// How many pictures were shown in the last second or so.
class FrameRate {
public:
    void frameShown() {
        const double now = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
        const double interval = now - last_;
        last_ = now;
        constexpr double pause = 0.5;  // s: then nothing changed, and nothing needed to be drawn
        if (interval > pause) return;
        interval_ += (interval - interval_) / (frames_ < 30 ? ++frames_ : 30);
    }
    double perSecond() const { return interval_ > 0.0 ? 1.0 / interval_ : 0.0; }

private:
    double last_ = 0.0, interval_ = 0.0;
    int frames_ = 0;
};

class Viewer {
public:
    Viewer(const Options& options, const Scene& scene, ViewerLink& link)
        : options_(options),
          link_(link),
          radii_(scene.spheres.radii),
          window_(scene.bounds, options.windowWidth, options.windowHeight,
                  "Ballpit: " + scene.name) {
        addKeys();
        tellView();
        link_.remote.change([&](Wishes& w) { w.colorBy = coloringNamed(options.color); });
        window_.setRenderFunction([this] { showNewest(); });
    }

    /// Until the window is closed.
    void run() { window_.run(); }

    /// From any thread: there will be no more steps.
    void simulationEnded() { ended_ = true; }

private:
    void addKeys() {
        const auto key = [this](char letter, const char* meaning, auto change) {
            window_.addKey(letter, meaning, [this, change] { link_.remote.change(change); });
        };
        key('v', "start or stop recording", [](Wishes& w) { w.recording = !w.recording; });
        key('l', "this text on or off", [](Wishes& w) { w.ledger = !w.ledger; });
        key('c', "next colouring: speed, contacts, cell...",
            [](Wishes& w) { w.colorBy = nextColoring(w.colorBy); });
        key('n', "one step, then pause", [](Wishes& w) {
            w.paused = true;
            ++w.singleSteps;
        });
        key(' ', "pause or go on", [](Wishes& w) { w.paused = !w.paused; });
    }

    /// The view, for recordings.
    void tellView() {
        link_.remote.change([this](Wishes& w) {
            w.camera = window_.camera();
            w.style = window_.style();
            w.width = window_.width();
            w.height = window_.height();
        });
    }

    /// Called sixty times a second.
    void showNewest() {
        report();
        if (ended_ || StopRequest::received()) return window_.close();
        const bool isNew = link_.snapshots.take(shown_);
        const bool viewChanged = window_.needsRedraw();
        if (viewChanged) tellView();
        const bool nothingYet = shown_.positions.empty();
        if (nothingYet || (!isNew && !viewChanged)) return;
        rate_.frameShown();
        window_.render(shown_.positions, radii_, shown_.colors, textOver());
        if (options_.reportState) report_ = stateLine();
    }

    std::string textOver() const {
        if (!link_.remote.wishes().ledger) return {};
        std::string text = ledgerText(shown_.ledger, true, rate_.perSecond()) + '\n';
        if (shown_.paused) text += "PAUSED (Space goes on, N makes a step)\n";
        if (shown_.colorBy != ColorBy::body)
            text += std::string("colour by ") + name(shown_.colorBy) + '\n';
        if (!shown_.message.empty()) text += shown_.message + '\n';
        return text + "H shows the keys\n";
    }

    /// For tests: tells what is on the screen, once freeglut has sent the last picture on its way:
    /// after the next look at the events.
    void report() {
        if (!report_.empty()) std::cout << report_ << std::endl;
        report_.clear();
    }

    /// What was drawn, as JSON.
    std::string stateLine() const {
        const OrbitCamera& orbit = window_.orbit();
        const Ledger& ledger = shown_.ledger;
        const bool measured = ledger.figures.step == ledger.step;
        const nlohmann::json state{{"step", ledger.step},
                                   {"hash", measured ? hashText(ledger.figures.hash) : ""},
                                   {"paused", shown_.paused},
                                   {"color", name(shown_.colorBy)},
                                   {"wireframe", window_.style().wireframe},
                                   {"grid", window_.style().floorGrid},
                                   {"keys", window_.showsKeys()},
                                   {"ledger", link_.remote.wishes().ledger},
                                   {"recording", shown_.recording},
                                   {"message", shown_.message},
                                   {"width", window_.width()},
                                   {"height", window_.height()},
                                   {"yaw", orbit.yaw},
                                   {"pitch", orbit.pitch},
                                   {"distance", orbit.distance},
                                   {"target", {orbit.target.x, orbit.target.y, orbit.target.z}}};
        return state.dump();
    }

    const Options& options_;
    ViewerLink& link_;
    std::vector<float> radii_;
    OpenGLVisualizer window_;
    Snapshot shown_;
    FrameRate rate_;
    std::string report_;
    std::atomic<bool> ended_ = false;
};

/// A thread that, when this scope ends in whatever way, is told to stop and awaited: it must not
/// outlive what it works on.
class Simulation {
public:
    Simulation(RemoteControl& remote, std::function<void()> work)
        : remote_(remote), thread_(std::move(work)) {}
    ~Simulation() {
        remote_.change([](Wishes& wishes) { wishes.stop = true; });
        thread_.join();
    }
    Simulation(const Simulation&) = delete;

private:
    RemoteControl& remote_;
    std::thread thread_;
};

}  // namespace

void runBesideWindow(const Options& options, const Scene& scene,
                     const std::function<void(ViewerLink*)>& simulate) {
    ViewerLink link;
    Viewer viewer(options, scene, link);
    std::exception_ptr failure;
    {
        const Simulation simulation(link.remote, [&] {
            try {
                simulate(&link);
            } catch (...) {
                failure = std::current_exception();
            }
            viewer.simulationEnded();
        });
        viewer.run();
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace ballpit
