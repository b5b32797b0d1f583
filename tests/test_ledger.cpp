// What a window tells and how it gets there: the ledger's lines and rhythms, and the hand-over of
// pictures and wishes between two threads.
#include "10_full_system/ledger.h"
#include "10_full_system/viewer_link.h"
#include "tests/catch.h"

#include <algorithm>
#include <thread>

using namespace ballpit;
using namespace std::chrono_literals;

namespace {

Ledger exampleLedger() {
    Ledger ledger{.scene = "gravity_fall", .balls = 500, .step = 120, .seconds = 2.0};
    ledger.contacts = 163;
    ledger.stepMilliseconds = 0.25;
    ledger.stages = {{"sort", 0.125}, {"broad phase", 0.0625}};
    ledger.figures.step = 118;
    ledger.figures.hash = 0xABC;
    ledger.figures.metrics.kineticEnergy = 1000.0;
    ledger.figures.metrics.potentialEnergy = 234.5;
    ledger.figures.metrics.momentum = {3.0, -4.0, 0.0};
    ledger.figures.metrics.largestPenetration = 0.0125;
    return ledger;
}

bool hasLine(const std::string& text, const std::string& line) {
    return ('\n' + text).find('\n' + line + '\n') != std::string::npos;
}

}  // namespace

TEST_CASE("the ledger's lines are those worked out by hand") {
    CHECK(ledgerText(exampleLedger(), true, 59.94) ==
          "gravity_fall                   500 balls\n"
          "step                           120\n"
          "simulated time               2.000 s\n"
          "contacts                       163\n"
          "\n"
          "a step takes                 0.250 ms\n"
          "  sort                       0.125 ms\n"
          "  broad phase                0.062 ms\n"
          "frames a second               59.9\n"
          "\n"
          "measured at step               118\n"
          "energy                      1234.5 J\n"
          "  kinetic                   1000.0 J\n"
          "momentum                       5.0 kg m/s\n"
          "largest penetration         0.0125 m\n"
          "state hash              0000000000000abc\n");
}

TEST_CASE("without times, nothing in the ledger depends on the machine or on the moment") {
    Ledger slow = exampleLedger();
    slow.stepMilliseconds = 99.0;
    slow.stages = {{"sort", 98.0}};
    CHECK(ledgerText(slow, false) == ledgerText(exampleLedger(), false));
    CHECK(ledgerText(slow, false).find("ms") == std::string::npos);
    CHECK(hasLine(ledgerText(slow, false), "state hash              0000000000000abc"));
}

TEST_CASE(
    "before anything was measured, the ledger shows no figures, and lost balls only if any are") {
    Ledger ledger = exampleLedger();
    CHECK(ledgerText(ledger, false).find("lost") == std::string::npos);
    ledger.figures.metrics.lost = 2;
    CHECK(hasLine(ledgerText(ledger, false), "balls lost                       2"));
    ledger.figures.step = -1;
    CHECK(ledgerText(ledger, false).find("energy") == std::string::npos);
    CHECK(hasLine(ledgerText(ledger, false), "contacts                       163"));
}

TEST_CASE("a recording's figures are measured by the step, never by the clock") {
    for (long step = 1; step <= 60; ++step) {
        CHECK(recordingMeasures(step, 19'999));
        CHECK(recordingMeasures(step, 20'000) == (step % 15 == 0));
    }
}

TEST_CASE("a window measures four times a second at most, and for a tenth of the time at most") {
    MeasuringRhythm rhythm;
    const MeasuringRhythm::Clock::time_point start{1000s};
    CHECK(rhythm.isDue(start));
    rhythm.measured(start, start + 1ms);
    CHECK(!rhythm.isDue(start + 250ms));
    CHECK(rhythm.isDue(start + 251ms));
    rhythm.measured(start, start + 100ms);
    CHECK(!rhythm.isDue(start + 999ms));
    CHECK(rhythm.isDue(start + 1000ms));
}

TEST_CASE("a hand-over gives the newest value, once") {
    Handover<int> handover;
    int seen = 0, made = 1;
    CHECK(handover.isAwaited());
    CHECK(!handover.take(seen));
    handover.publish(made);
    CHECK(!handover.isAwaited());
    made = 2;
    handover.publish(made);
    CHECK(handover.take(seen));
    CHECK(seen == 2);
    CHECK(handover.isAwaited());
    CHECK(!handover.take(seen));
    CHECK(seen == 2);
}

TEST_CASE("a picture handed from thread to thread is whole, and none is older than the last") {
    constexpr int pictures = 20'000;
    constexpr std::size_t balls = 500;
    Handover<std::vector<int>> handover;
    std::thread writer([&] {
        std::vector<int> picture;
        for (int k = 1; k <= pictures; ++k) {
            picture.assign(balls, k);
            handover.publish(picture);
        }
    });
    int last = 0, torn = 0, older = 0;
    for (std::vector<int> picture; last < pictures;) {
        if (!handover.take(picture)) continue;
        torn += picture.size() != balls ||
                std::count(picture.begin(), picture.end(), picture.front()) != int(balls);
        older += picture.front() <= last;
        last = picture.front();
    }
    writer.join();
    CHECK(torn == 0);
    CHECK(older == 0);
}

TEST_CASE("the simulation hears of a wish at once, and waits no longer than it said") {
    RemoteControl remote;
    using Clock = RemoteControl::Clock;
    const auto begin = Clock::now();
    CHECK(!remote.awaitChange(begin + 20ms).paused);
    CHECK(Clock::now() >= begin + 20ms);

    std::thread window([&] { remote.change([](Wishes& wishes) { wishes.paused = true; }); });
    CHECK(remote.awaitChange(begin + 60s).paused);
    CHECK(Clock::now() < begin + 30s);
    window.join();
    CHECK(remote.wishes().paused);
    CHECK(remote.awaitChange(Clock::now() + 1ms).paused);  // nothing new, and no wish is forgotten
}
