// The ledger's lines and rhythms.
#include "10_full_system/ledger.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace ballpit {
namespace {

class Lines {
public:
    template <class... Values>
    void add(const char* what, const char* pattern, Values... values) {
        std::array<char, 64> value{};
        std::snprintf(value.data(), value.size(), pattern, values...);
        std::array<char, 128> line{};
        std::snprintf(line.data(), line.size(), "%-20s %s\n", what, value.data());
        text_ += line.data();
    }
    void gap() { text_ += '\n'; }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

void addTimes(Lines& lines, const Ledger& ledger, std::optional<double> framesPerSecond) {
    lines.gap();
    lines.add("ms a step", "%9.3f", ledger.stepMilliseconds);
    for (const StageTime& time : ledger.figures.stages)
        lines.add(("  " + time.stage).c_str(), "%9.3f", time.milliseconds);
    if (framesPerSecond) lines.add("frames a second", "%7.1f", *framesPerSecond);
}

void addFigures(Lines& lines, const MeasuredFigures& figures) {
    const Metrics& m = figures.metrics;
    lines.gap();
    lines.add("measured at step", "%5ld", figures.step);
    lines.add("energy", "%.6g J", m.kineticEnergy + m.potentialEnergy);
    lines.add("  kinetic", "%.6g J", m.kineticEnergy);
    lines.add("momentum", "%.4g kg m/s", length(m.momentum));
    lines.add("largest penetration", "%.4f m", m.largestPenetration);
    lines.add("state hash", "%s", hashText(figures.hash).c_str());
    if (m.lost) lines.add("balls lost", "%zu", m.lost);
}

}  // namespace

std::string ledgerText(const Ledger& ledger, bool withTimes,
                       std::optional<double> framesPerSecond) {
    Lines lines;
    lines.add(ledger.scene.c_str(), "%5zu balls", ledger.balls);
    lines.add("step", "%5ld", ledger.step);
    lines.add("time", "%9.3f s", ledger.seconds);
    lines.add("contacts", "%5zu", ledger.contacts);
    if (withTimes) addTimes(lines, ledger, framesPerSecond);
    if (ledger.figures.step >= 0) addFigures(lines, ledger.figures);
    return lines.text();
}

bool recordingMeasures(long step, std::size_t balls) {
    constexpr std::size_t manyBalls = 20'000;
    return balls < manyBalls || step % 15 == 0;
}

void MeasuringRhythm::measured(Clock::time_point start, Clock::time_point end) {
    constexpr std::chrono::milliseconds quarterSecond(250);
    next_ = end + std::max<Clock::duration>(quarterSecond, 9 * (end - start));
}

}  // namespace ballpit
