// Chapter 12's checks of a decision of the plan, and of where the original loop lies on the chart.
#pragma once

#include <cmath>

#include "10_full_system/physics_simulator.cuh"
#include "12_speed_and_accuracy/parts.h"
#include "stability/scenes.h"
#include "tests/checks/check_12_front.cuh"

namespace ballpit::check {

// ---- into how many parts?

/// All binary fractions, so that what lies on a threshold lies on it exactly.
struct Cut {
    double whole, limit;
    int most, now, parts;  ///< the last: worked out by hand
    int got() const { return partsFor(whole, limit, most, now); }
};

inline std::string words(const Cut& cut) {
    return brief(cut.whole) + " in parts of " + brief(cut.limit) + " each, most " + text(cut.most) +
           (cut.now ? ", " + text(cut.now) + " now" : "");
}

inline void requireParts(Report& report, const std::vector<Cut>& cuts) {
    for (const Cut& cut : cuts)
        if (cut.got() != cut.parts) report.fail(words(cut), text(cut.got()), text(cut.parts));
}

/// The mistake explains what was got if it does so in every case.
template <class Wrong>
Mistake partsMistake(const char* name, const std::vector<Cut>& cuts, Wrong wrong) {
    return {name, [&cuts, wrong] {
                return std::all_of(cuts.begin(), cuts.end(),
                                   [&](const Cut& c) { return c.got() == wrong(c); });
            }};
}

inline int inRange(double parts, int most) {
    return static_cast<int>(std::min(std::max(parts, 1.0), double(most)));
}

inline void partsByHand(Report& report) {
    static const std::vector<Cut> cuts{{0, 0.25, 64, 0, 1},
                                       {0.125, 0.25, 64, 0, 1},
                                       {0.25, 0.25, 64, 0, 1},
                                       {0.2578125, 0.25, 64, 0, 2},
                                       {0.5, 0.25, 64, 0, 2},
                                       {0.5078125, 0.25, 64, 0, 3},
                                       {8, 0.25, 64, 0, 32},
                                       {16, 0.25, 64, 0, 64},
                                       {17, 0.25, 64, 0, 64},
                                       {1000, 0.25, 64, 0, 64},
                                       {infinite, 0.25, 64, 0, 64},
                                       {1, 0, 64, 0, 64},
                                       {8, 4, 64, 0, 2},
                                       {3, 1, 2, 0, 2}};
    requireParts(report, cuts);
    const auto mistake = [](const char* name, auto parts) {
        return partsMistake(name, cuts, [parts](const Cut& c) {
            return c.limit > 0 ? inRange(parts(c), c.most) : c.most;
        });
    };
    report.guess({mistake("rounded down: each part is a little too large",
                          [](const Cut& c) { return std::floor(c.whole / c.limit); }),
                  mistake("rounded to the nearest: half of the parts are too large",
                          [](const Cut& c) { return std::round(c.whole / c.limit); }),
                  mistake("one more than rounded down: one too many on the threshold",
                          [](const Cut& c) { return std::floor(c.whole / c.limit) + 1; }),
                  mistake("limit over whole: upside down",
                          [](const Cut& c) { return std::ceil(c.limit / c.whole); })});
}

/// As few as possible: they suffice, and one fewer does not.
inline void fewestParts(Report& report) {
    Random random(report.seed + 50);
    for (int k = 0; k < 1000; ++k) {
        const Cut cut{random.uniform(0, 20), random.uniform(0.05f, 1), 1000, 0, 0};
        const int parts = cut.got();
        const double slack = 1 + 1e-6;
        if (parts < 1)
            report.fail(words(cut), text(parts), "at least 1");
        else if (cut.whole / parts > cut.limit * slack)
            report.fail(words(cut) + ": each of " + text(parts), brief(cut.whole / parts),
                        "at most " + brief(cut.limit));
        else if (parts > 1 && cut.whole / (parts - 1) * slack < cut.limit)
            report.fail(words(cut) + ": one fewer suffices", text(parts), text(parts - 1));
    }
}

/// More is asked for: never fewer parts.
inline void monotoneParts(Report& report) {
    Random random(report.seed + 51);
    for (int k = 0; k < 1000; ++k) {
        const Cut cut{random.uniform(0, 20), random.uniform(0.05f, 1), 100,
                      static_cast<int>(random.uniform(0, 12)), 0};
        const double more = random.uniform(1, 3);
        const Cut larger{cut.whole * more, cut.limit, cut.most, cut.now, 0};
        const Cut stricter{cut.whole, cut.limit / more, cut.most, cut.now, 0};
        for (const Cut& harder : {larger, stricter})
            if (harder.got() < cut.got())
                report.fail(words(cut) + "; then " + words(harder), text(harder.got()),
                            "at least " + text(cut.got()));
    }
}

/// Parts that are there stay between just enough and twice as many as needed.
inline void partsThatStay(Report& report) {
    static const std::vector<Cut> cuts{
        {1, 0.25, 64, 4, 4},    {0.75, 0.25, 64, 4, 4},      {0.625, 0.25, 64, 4, 4},
        {0.5, 0.25, 64, 4, 2},  {0.25, 0.25, 64, 4, 1},      {0, 0.25, 64, 2, 1},
        {1.25, 0.25, 64, 4, 5}, {1.0078125, 0.25, 64, 4, 5}, {4, 0.25, 64, 4, 16},
        {0, 0.25, 64, 1, 1},    {0.625, 0.25, 64, 5, 5},     {0.5, 0.25, 64, 5, 2}};
    requireParts(report, cuts);
    const auto wanted = [](const Cut& c) { return inRange(std::ceil(c.whole / c.limit), c.most); };
    report.guess(
        {partsMistake("those of now are not asked for: a scene on a threshold goes to and fro",
                      cuts, wanted),
         partsMistake("never fewer than now: what a scene needed once it pays for good", cuts,
                      [=](const Cut& c) { return std::max(c.now, wanted(c)); }),
         partsMistake("those of now stay even if they are too few", cuts,
                      [=](const Cut& c) { return 2 * wanted(c) > c.now ? c.now : wanted(c); })});
}

/// Substeps: 1 / n^2 of the overlap of one.
struct Sinking {
    double overlapOfOne, tolerance;
    int substeps;
    int got() const { return substepsFor(overlapOfOne, tolerance, 100, 0); }
};

inline void substepsByHand(Report& report) {
    const std::vector<Sinking> sinkings{
        {0, 0.25, 1},        {0.25, 0.25, 1},        {0.2578125, 0.25, 2}, {1, 0.25, 2},
        {1.0625, 0.25, 3},   {2.25, 0.25, 3},        {1, 0.0625, 4},       {4, 0.0625, 8},
        {1, 1.0 / 4096, 64}, {100, 1.0 / 4096, 100}, {1, 0, 100}};
    for (const Sinking& s : sinkings)
        if (s.got() != s.substeps)
            report.fail("overlap " + brief(s.overlapOfOne) + " r with 1 substep, tolerance " +
                            brief(s.tolerance) + ": substeps",
                        text(s.got()), text(s.substeps));
    const auto mistake = [&](const char* name, auto parts) -> Mistake {
        return {name, [&sinkings, parts] {
                    return std::all_of(sinkings.begin(), sinkings.end(), [&](const Sinking& s) {
                        return s.got() ==
                               (s.tolerance > 0 ? inRange(std::ceil(parts(s)), 100) : 100);
                    });
                }};
    };
    report.guess({mistake("as if twice the substeps left half the overlap: they leave a quarter",
                          [](const Sinking& s) { return s.overlapOfOne / s.tolerance; }),
                  mistake("the tolerance without its root",
                          [](const Sinking& s) { return std::sqrt(s.overlapOfOne) / s.tolerance; }),
                  mistake("the overlap without its root", [](const Sinking& s) {
                      return s.overlapOfOne / std::sqrt(s.tolerance);
                  })});
}

// ---- the original loop on the chart

/// m, of all contacts of balls and walls.
inline std::vector<double> depthsOf(const Spheres& balls, Bounds walls) {
    std::vector<double> depths;
    for (const auto [a, b] : findPairsOnHost(balls))
        depths.push_back(double(balls.radii[a]) + balls.radii[b] -
                         length(balls.positions[a] - balls.positions[b]));
    for (std::size_t k = 0; k < balls.count(); ++k)
        for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z})
            for (const float gap : {balls.positions[k].*axis - walls.lower.*axis,
                                    walls.upper.*axis - balls.positions[k].*axis})
                if (gap < balls.radii[k]) depths.push_back(double(balls.radii[k]) - gap);
    return depths;
}

struct Spot {
    double error, visits;  ///< in radii at the end; pairs times passes in a simulated second
};

/// 666 for 2 s.
inline Spot spotOf(Report& report, ResponseMethod method, std::optional<int> substeps, int passes) {
    const Scene scene = stability::makeSixCubed(0, report.seed);
    SimulatorSettings settings = settingsFor(scene, report.device);
    settings.response = method;
    settings.substeps = substeps;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    constexpr int seconds = 2, steps = 60 * seconds;
    std::size_t visits = 0;
    for (int k = 0; k < steps; ++k) {
        simulator.step();
        visits += simulator.lastPairs().size() * static_cast<std::size_t>(passes);
    }
    const Spheres end = simulator.bodies().download();
    return {rmsOverlap(depthsOf(end, scene.bounds), end.count(), end.radii[0]),
            static_cast<double>(visits) / seconds};
}

inline void originalLoop(Report& report) {
    const Spot original = spotOf(report, ResponseMethod::massSplit, {}, 2);
    const Spot small = spotOf(report, ResponseMethod::smallSteps, 3, 3);
    const WorkPoint a{1 / original.visits, original.error}, b{1 / small.visits, small.error};
    if (!dominates(b, a))
        report.fail("666, three small steps against the original loop",
                    "error " + brief(small.error) + " and " + brief(small.visits) + " visits",
                    "below " + brief(original.error) + " and " + brief(original.visits));
    report.measured("666 after 2 s, rms overlap / r: the original loop " + brief(original.error) +
                    " with " + brief(original.visits) +
                    " pair visits a second, three small steps " + brief(small.error) + " with " +
                    brief(small.visits));
}

}  // namespace ballpit::check
