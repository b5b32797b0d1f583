// The simulation's side of a window: it keeps real time, obeys pause and single step, and hands out
// pictures. It never waits for the window to draw.
#pragma once

#include <iostream>

#include "10_full_system/observation.cuh"
#include "10_full_system/user_recording.h"
#include "10_full_system/viewer_link.h"

namespace ballpit {

class WindowFeed {
public:
    WindowFeed(ViewerLink& link, const Options& options, const Scene& scene)
        : link_(link),
          tell_(options.json ? std::cerr : std::cout),
          dt_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<float>(scene.dt))),
          wishes_(link.remote.wishes()),
          recording_(scene.bounds, scene.name) {}

    /// Returns when the next step is due: a dt after the one before, or as soon as the user asks
    /// for it. False if the user wants no more.
    bool awaitTurn(Observation& now) {
        constexpr std::chrono::milliseconds patience(100);
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
        due_ = std::max(due_, Clock::now() - dt_) + dt_;
        return true;
    }

    /// Will the next step's times be shown? As often as its figures: on a GPU, timing costs.
    bool wantsTimes() const {
        return wishes_.ledger && (wishes_.paused || rhythm_.isDue(Clock::now()));
    }

    /// A step was done: records it if the user records, and shows it if the window has seen the
    /// last one.
    void stepDone(Observation& now) {
        if (recording_.isRunning()) record(now);
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
        snapshot_.recording = recording_.path();
        snapshot_.message = recording_.message();
        link_.snapshots.publish(snapshot_);
    }

    /// Completes what the user still records.
    void finish() {
        if (recording_.isRunning()) finishRecording();
    }

private:
    using Clock = RemoteControl::Clock;

    /// Takes in new wishes; if they change the picture of a state that stands still, shows it
    /// again.
    void follow(const Wishes& wishes, Observation& now) {
        const Wishes before = std::exchange(wishes_, wishes);
        if (before.paused && !wishes_.paused) due_ = Clock::now();
        const bool recorded = recording_.isRunning();
        if (wishes_.recording && !recorded) recording_.start(wishes_.width, wishes_.height);
        if (!wishes_.recording && recorded) finishRecording();
        if (wishes_.recording && !recording_.isRunning()) giveUpRecording();
        const bool looksOther =
            before.colorBy != wishes_.colorBy || before.ledger != wishes_.ledger ||
            before.paused != wishes_.paused || before.recording != wishes_.recording;
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

    void record(Observation& now) {
        now.writeInto(ledger_);
        recording_.capture(wishes_.camera, wishes_.style, now.positions(), now.radii(),
                           now.colors(wishes_.colorBy),
                           wishes_.ledger ? ledgerText(ledger_, true) : "");
        if (!recording_.isRunning()) giveUpRecording();
    }

    void finishRecording() {
        recording_.finish();
        tell_ << recording_.message() << std::endl;
    }

    /// It failed; the user must ask anew.
    void giveUpRecording() {
        link_.remote.change([](Wishes& wishes) { wishes.recording = false; });
    }

    ViewerLink& link_;
    std::ostream& tell_;  ///< where people look; with --json that is not where programs look
    Clock::duration dt_;
    Wishes wishes_;
    Clock::time_point due_ = Clock::now();
    long singleStepsDone_ = 0;
    MeasuringRhythm rhythm_;
    Ledger ledger_;
    Snapshot snapshot_;
    UserRecording recording_;
};

}  // namespace ballpit
