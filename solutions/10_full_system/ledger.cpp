// The ledger's lines and rhythms.
#include "10_full_system/ledger.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace ballpit {
namespace {

/// "contacts                       163"; units stand behind the column of numbers.
class Lines {
public:
    template <class Number>
    void add(const std::string& what, const char* pattern, Number number, const char* unit = "") {
        std::array<char, 32> digits{};
        std::snprintf(digits.data(), digits.size(), pattern, number);
        std::array<char, 128> line{};
        std::snprintf(line.data(), line.size(), "%-24s%10s%s%s\n", what.c_str(), digits.data(),
                      *unit ? " " : "", unit);
        text_ += line.data();
    }
    void gap() { text_ += '\n'; }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

void addTimes(Lines& lines, const Ledger& ledger, std::optional<double> framesPerSecond) {
    lines.gap();
    lines.add("a step takes", "%.3f", ledger.stepMilliseconds, "ms");
    for (const StageTime& time : ledger.stages)
        lines.add("  " + time.stage, "%.3f", time.milliseconds, "ms");
    if (framesPerSecond) lines.add("frames a second", "%.1f", *framesPerSecond);
}

void addFigures(Lines& lines, const MeasuredFigures& figures) {
    const Metrics& m = figures.metrics;
    lines.gap();
    lines.add("measured at step", "%ld", figures.step);
    lines.add("energy", "%.1f", m.kineticEnergy + m.potentialEnergy, "J");
    lines.add("  kinetic", "%.1f", m.kineticEnergy, "J");
    lines.add("momentum", "%.1f", length(m.momentum), "kg m/s");
    lines.add("largest penetration", "%.4f", m.largestPenetration, "m");
    if (m.lost) lines.add("balls lost", "%zu", m.lost);
    lines.add("state hash", "%s", hashText(figures.hash).c_str());
}

}  // namespace

std::string ledgerText(const Ledger& ledger, bool withTimes,
                       std::optional<double> framesPerSecond) {
    Lines lines;
    lines.add(ledger.scene, "%zu", ledger.balls, "balls");
    lines.add("step", "%ld", ledger.step);
    lines.add("simulated time", "%.3f", ledger.seconds, "s");
    lines.add("contacts", "%zu", ledger.contacts);
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
