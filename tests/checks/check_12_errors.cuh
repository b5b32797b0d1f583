// Chapter 12's checks of errors: overlaps and drifts, by hand and against sums made another way.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "12_speed_and_accuracy/errors.h"
#include "common/random.h"
#include "tests/checks/check_07_oracle.cuh"

namespace ballpit::check {

/// A number in a sentence: "0.2", where text() would say 0.200000003.
inline std::string brief(double value) {
    char words[32];
    std::snprintf(words, sizeof words, "%.4g", value);
    return words;
}

// ---- overlaps

/// Contacts of some balls, and the error that they are.
struct Heap {
    const char* what;
    std::vector<double> depths;  ///< m
    std::size_t balls;
    double radius, error;  ///< worked out by hand
};

inline const std::vector<Heap>& heapsByHand() {
    static const std::vector<Heap> heaps{
        {"no ball at all", {}, 0, 0.5, 0},
        {"one ball that touches nothing", {}, 1, 0.5, 0},
        {"one ball, 1 cm deep in the floor", {0.01}, 1, 0.5, 0.02},
        {"one ball, 3 and 4 cm deep in two walls", {0.03, 0.04}, 1, 0.5, 0.1},
        {"two balls, 4 cm deep in each other", {0.04}, 2, 0.5, 0.08 / std::sqrt(2.0)},
        {"two balls, one contact of 2 cm and one of 0", {0.02, 0}, 2, 0.1, 0.2 / std::sqrt(2.0)},
        {"33 balls in a row, 1 mm deep each", std::vector<double>(32, 0.001), 33, 0.1,
         0.01 * std::sqrt(32.0 / 33.0)},
        {"33 balls, one contact of 33 mm", {0.033}, 33, 0.33, 0.1 / std::sqrt(33.0)}};
    return heaps;
}

/// The mistake explains what was got if it does so for every heap with a contact.
template <class Wrong>
Mistake overlapMistake(const char* words, Wrong wrong) {
    return {words, [wrong] {
                return std::all_of(heapsByHand().begin(), heapsByHand().end(), [&](const Heap& h) {
                    if (h.depths.empty()) return true;
                    double squares = 0, sum = 0;
                    for (const double d : h.depths) squares += d * d, sum += d;
                    const double got = rmsOverlap(h.depths, h.balls, h.radius);
                    return std::abs(got - wrong(h, squares, sum)) < 1e-9;
                });
            }};
}

inline void guessOverlap(Report& report) {
    using D = double;
    const auto n = [](const Heap& h) { return static_cast<D>(h.balls); };
    const auto contacts = [](const Heap& h) { return static_cast<D>(h.depths.size()); };
    report.guess(
        {overlapMistake("divided by the contacts, not by the balls: many shallow contacts hide a "
                        "deep one",
                        [=](const Heap& h, D squares, D) {
                            return std::sqrt(squares / contacts(h)) / h.radius;
                        }),
         overlapMistake("a mean of depths, without squares: the shallow ones hide the deep",
                        [=](const Heap& h, D, D sum) { return sum / n(h) / h.radius; }),
         overlapMistake("in metres: not divided by the radius",
                        [=](const Heap& h, D squares, D) { return std::sqrt(squares / n(h)); }),
         overlapMistake("without the root",
                        [=](const Heap& h, D squares, D) { return squares / n(h) / h.radius; }),
         overlapMistake("a sum: not divided by the balls", [](const Heap& h, D squares, D) {
             return std::sqrt(squares) / h.radius;
         })});
}

inline void overlapByHand(Report& report) {
    for (const Heap& heap : heapsByHand())
        requireNear(report, heap.what, rmsOverlap(heap.depths, heap.balls, heap.radius), heap.error,
                    1e-9);
    guessOverlap(report);
}

/// Two heaps like one have its error; so has one twice as large in every length.
inline void overlapWithoutUnits(Report& report) {
    Random random(report.seed);
    for (const std::size_t balls : {2, 33, 255, 256, 257, 1000}) {
        std::vector<double> depths;
        for (std::size_t k = 0; k < 3 * balls; ++k) depths.push_back(random.uniform(0, 0.02f));
        std::vector<double> twice = depths, large = depths;
        twice.insert(twice.end(), depths.begin(), depths.end());
        for (double& depth : large) depth *= 2;
        const double one = rmsOverlap(depths, balls, 0.5);
        const std::string where = text(balls) + " balls";
        requireNear(report, where + ", two such heaps", rmsOverlap(twice, 2 * balls, 0.5), one,
                    1e-9);
        requireNear(report, where + ", all lengths doubled", rmsOverlap(large, balls, 1.0), one,
                    1e-9);
        if (!(one > 0)) report.fail(where + ", error", brief(one), "above 0");
    }
}

// ---- drifts

/// Energies after a reference, and what becomes of them.
struct Track {
    const char* what;
    double reference;
    std::vector<double> energies;  ///< J
    double last, mean, rms, largest;
};

inline const std::vector<Track>& tracksByHand() {
    static const double root = std::sqrt(0.5);
    static const std::vector<Track> tracks{
        {"nothing added", 10, {}, 0, 0, 0, 0},
        {"10 J, then 12", 10, {12}, 0.2, 0.2, 0.2, 0.2},
        {"10 J, then 9", 10, {9}, -0.1, -0.1, 0.1, 0.1},
        {"10 J, then 11 and 9", 10, {11, 9}, -0.1, 0, 0.1, 0.1},
        {"10 J, then 7, 10, 7 and 10", 10, {7, 10, 7, 10}, 0, -0.15, 0.3 * root, 0.3},
        {"-4 J, then -3: it gains", -4, {-3}, 0.25, 0.25, 0.25, 0.25},
        {"-4 J, then -5: it loses", -4, {-5}, -0.25, -0.25, 0.25, 0.25}};
    return tracks;
}

inline EnergyDrift driftOf(double reference, const std::vector<double>& energies) {
    EnergyDrift drift(reference);
    for (const double energy : energies) drift.add(energy);
    return drift;
}

/// The mistake explains all last changes and means, if each change is what `wrong` says.
template <class Wrong>
Mistake driftMistake(const char* words, Wrong wrong) {
    return {
        words, [wrong] {
            for (const Track& t : tracksByHand()) {
                const EnergyDrift got = driftOf(t.reference, t.energies);
                double sum = 0, last = 0;
                for (const double e : t.energies) sum += last = wrong(e, t.reference);
                const auto count = static_cast<double>(std::max<std::size_t>(1, t.energies.size()));
                if (std::abs(got.last() - last) > 1e-9 || std::abs(got.mean() - sum / count) > 1e-9)
                    return false;
            }
            return true;
        }};
}

inline void driftByHand(Report& report) {
    for (const Track& track : tracksByHand()) {
        const EnergyDrift drift = driftOf(track.reference, track.energies);
        const std::string where = std::string(track.what) + ": ";
        requireNear(report, where + "last", drift.last(), track.last, 1e-9);
        requireNear(report, where + "mean", drift.mean(), track.mean, 1e-9);
        requireNear(report, where + "rms", drift.rms(), track.rms, 1e-9);
        requireNear(report, where + "largest", drift.largest(), track.largest, 1e-9);
    }
    report.guess(
        {driftMistake("over the energy of now, not of the start",
                      [](double e, double start) { return (e - start) / std::abs(e); }),
         driftMistake("over a reference with its sign: below 0 a gain looks like a loss",
                      [](double e, double start) { return (e - start) / start; }),
         driftMistake("without its sign: a loss looks like a gain",
                      [](double e, double start) { return std::abs(e - start) / std::abs(start); }),
         driftMistake("in joules, not as a share of the reference",
                      [](double e, double start) { return e - start; }),
         driftMistake("the wrong way round: a gain is above 0",
                      [](double e, double start) { return (start - e) / std::abs(start); })});
}

/// The same numbers from all energies at once, in long doubles.
inline void driftAtRandom(Report& report) {
    Random random(report.seed + 1);
    for (const std::size_t count : {1, 2, 33, 255, 256, 257, 1000}) {
        std::vector<double> energies;
        for (std::size_t k = 0; k < count; ++k) energies.push_back(random.uniform(5, 25));
        const EnergyDrift drift = driftOf(20, energies);
        long double sum = 0, squares = 0, largest = 0;
        for (const double energy : energies) {
            const long double change = (static_cast<long double>(energy) - 20) / 20;
            sum += change, squares += change * change;
            largest = std::max(largest, std::abs(change));
        }
        const auto n = static_cast<long double>(count);
        const std::string where = text(count) + " energies: ";
        requireNear(report, where + "mean", drift.mean(), static_cast<double>(sum / n), 1e-9);
        requireNear(report, where + "rms", drift.rms(), double(std::sqrt(squares / n)), 1e-9);
        requireNear(report, where + "largest", drift.largest(), double(largest), 1e-9);
    }
}

/// What went wrong once stays visible: in the mean and the rms for good.
inline void driftOfNoNumber(Report& report) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::vector<double>& energies :
         {std::vector<double>{nan}, {nan, 10}, {10, nan, 10}, {10, 10, nan}}) {
        const EnergyDrift drift = driftOf(10, energies);
        const std::string where =
            "NaN among " + text(energies.size()) + " energies that are right: ";
        for (const auto& [what, value] :
             {std::pair{"mean", drift.mean()}, std::pair{"rms", drift.rms()},
              std::pair{"largest", drift.largest()}})
            if (!std::isnan(value)) report.fail(where + what, brief(value), "nan");
    }
    report.guess({{"a NaN was left out: a run that blew up looks perfect", [&] {
                       return driftOf(10, {10, nan, 10}).rms() == 0;
                   }}});
}

}  // namespace ballpit::check
