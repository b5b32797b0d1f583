// The simulation's side of a window: it keeps real time, obeys pause and single step, and hands out
// pictures. It never waits for the window to draw.
#pragma once

#include <filesystem>
#include <iostream>

#include "10_full_system/observation.cuh"
#include "10_full_system/viewer_link.h"
#include "common/film.h"

namespace ballpit {

class WindowFeed {
public:
    WindowFeed(ViewerLink& link, const Options& options, const Scene& scene)
        : link_(link), options_(options), scene_(scene), wishes_(link.remote.wishes()) {}

    /// Returns when the next step is due: a dt after the one before, or as soon as the user asks
    /// for it. False if the user wants no more.
    bool awaitTurn(Observation& now) {
        for (;;) {
            follow(link_.remote.awaitChange(wishes_.paused ? Clock::now() + patience : due_), now);
            if (wishes_.stop) return false;
            if (singleStepsDone_ < wishes_.singleSteps) {
                ++singleStepsDone_;
                return true;
            }
            if (!wishes_.paused && Clock::now() >= due_) break;
        }
        // A simulation slower than real time does not try to catch up.
        due_ = std::max(due_, Clock::now() - dt()) + dt();
        return true;
    }

    /// Will the next step's times be shown? As often as its figures: on a GPU, timing costs.
    bool wantsTimes() const {
        return wishes_.ledger && (wishes_.paused || rhythm_.isDue(Clock::now()));
    }

    /// A step was done: shows it if the window has seen the last one, and records it if the user
    /// records.
    void stepDone(Observation& now) {
        if (clip_) record(now);
        if (wishes_.paused || link_.snapshots.isAwaited()) show(now);
    }

    /// Hands the state to the window.
    void show(Observation& now) {
        measureIfDue(now);
        snapshot_.positions = now.positions();
        snapshot_.colors = now.colors(wishes_.colorBy);
        snapshot_.ledger = ledger_;
        snapshot_.colorBy = wishes_.colorBy;
        snapshot_.paused = wishes_.paused;
        snapshot_.recording = clip_ ? clipPath_ : "";
        snapshot_.message = message_;
        link_.snapshots.publish(snapshot_);
    }

    /// Completes a recording that the user has started.
    void finish() {
        if (clip_) finishClip();
    }

private:
    using Clock = RemoteControl::Clock;
    static constexpr std::chrono::milliseconds patience{100};

    Clock::duration dt() const {
        return std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(scene_.dt));
    }

    /// Takes in new wishes; if they change the picture of a state that stands still, shows it
    /// again.
    void follow(const Wishes& wishes, Observation& now) {
        const bool wasPaused = wishes_.paused, hadLedger = wishes_.ledger;
        const ColorBy before = wishes_.colorBy;
        const bool recorded = clip_ != nullptr;
        wishes_ = wishes;
        if (wishes_.recording && !recorded) startClip();
        if (!wishes_.recording && recorded) finishClip();
        if (wasPaused && !wishes_.paused) due_ = Clock::now();
        const bool looksOther = before != wishes_.colorBy || hadLedger != wishes_.ledger ||
                                wasPaused != wishes_.paused || recorded != (clip_ != nullptr);
        if (looksOther && wishes_.paused) show(now);
    }

    /// A state that stands still is always measured: its hash can be read off.
    void measureIfDue(Observation& now) {
        now.writeInto(ledger_);
        const Clock::time_point start = Clock::now();
        if (!wishes_.ledger || !(wishes_.paused || rhythm_.isDue(start))) return;
        ledger_.figures = now.figures();
        rhythm_.measured(start, Clock::now());
    }

    // ---- What the user records: the window's view, one frame a step.

    void startClip() {
        try {
            clipPath_ = freeClipPath();
            const auto even = [](int size) { return std::max(2, size - size % 2); };
            clip_ = std::make_unique<Film>(
                FilmOrder{clipPath_, "", even(wishes_.width), even(wishes_.height)}, scene_.bounds);
            message_ = "recording " + clipPath_;
        } catch (const std::exception& error) {
            giveUpClip(error);
        }
    }

    void record(Observation& now) {
        try {
            now.writeInto(ledger_);
            clip_->look(wishes_.camera, wishes_.style);
            clip_->capture(now.positions(), now.radii(), now.colors(wishes_.colorBy),
                           wishes_.ledger ? ledgerText(ledger_, true) : "");
            ++clipFrames_;
        } catch (const std::exception& error) {
            giveUpClip(error);
        }
    }

    void finishClip() {
        try {
            if (clipFrames_ > 0) clip_->finish();
            message_ =
                clipFrames_ > 0 ? "saved " + clipPath_ : "nothing recorded: no step was made";
            tell() << message_ << " (" << clipFrames_ << " frames)" << std::endl;
            clip_.reset();
            clipFrames_ = 0;
        } catch (const std::exception& error) {
            giveUpClip(error);
        }
    }

    /// A recording that fails does not end the simulation.
    void giveUpClip(const std::exception& error) {
        clip_.reset();
        clipFrames_ = 0;
        message_ = std::string("not recorded: ") + error.what();
        std::cerr << "error: " << message_ << '\n';
        link_.remote.change([](Wishes& wishes) { wishes.recording = false; });
    }

    /// videos/gravity_fall_001.mp4 in the current folder, or the next number that is free.
    std::string freeClipPath() const {
        std::filesystem::create_directories("videos");
        for (int number = 1;; ++number) {
            std::string digits = std::to_string(number);
            digits.insert(0, 3 - std::min<std::size_t>(3, digits.size()), '0');
            const std::string path = "videos/" + scene_.name + "_" + digits + ".mp4";
            if (!std::filesystem::exists(path)) return path;
        }
    }

    /// Where people look; with --json that is not where programs look.
    std::ostream& tell() const { return options_.json ? std::cerr : std::cout; }

    ViewerLink& link_;
    const Options& options_;
    const Scene& scene_;
    Wishes wishes_;
    Clock::time_point due_ = Clock::now();
    long singleStepsDone_ = 0;
    MeasuringRhythm rhythm_;
    Ledger ledger_;
    Snapshot snapshot_;
    std::unique_ptr<Film> clip_;
    std::string clipPath_, message_;
    int clipFrames_ = 0;
};

}  // namespace ballpit
