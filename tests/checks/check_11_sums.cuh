// Chapter 11's checks of sums: the share that mass splitting leaves a contact, and what a plain sum
// of impulses does to the energy.
#pragma once

#include "11_stability/coloured_response.cuh"
#include "11_stability/jacobi_response.cuh"
#include "tests/checks/check_07_response.cuh"
#include "truth/collisions.h"

namespace ballpit::check {

/// All of every impulse and overlap, and everything bounces.
constexpr ContactRules plainRules{1.0f, 1.0f, 0.0f};

/// A number in a sentence: "0.2", where text() would say 0.200000003.
inline std::string brief(double value) {
    char words[32];
    std::snprintf(words, sizeof words, "%.3g", value);
    return words;
}
inline std::string brief(Vec3 v) {
    return "(" + brief(v.x) + ", " + brief(v.y) + ", " + brief(v.z) + ")";
}

inline Spheres summed(Device device, const Example& example, bool splitMasses) {
    JacobiResponse response(device, example.balls.count(), example.pairs.size(), plainRules,
                            splitMasses);
    return OneRound(device, example.balls, example.pairs).resolve(response);
}

inline Spheres pairByPairOnce(Device device, const Example& example) {
    ColouredResponse response(device, example.balls.count(), example.pairs.size(), plainRules);
    return OneRound(device, example.balls, example.pairs).resolve(response);
}

/// Ball and contact counts as a student would write them wrongly.
struct SplitCase {
    float massA, contactsA, massB, contactsB;
    double share;  ///< worked out by hand
};

inline std::vector<SplitCase> splitCases() {
    return {{1, 1, 1, 1, 1.0},       {1, 1, 1, 2, 2.0 / 3},     {1, 3, 1, 1, 0.5},
            {1, 2, 2, 4, 1.5 / 4},   {4, 1, 1, 3, 1.25 / 3.25}, {0.1f, 6, 10, 1, 10.1 / 60.1},
            {1, 12, 1, 12, 1.0 / 12}};
}

/// The mistake explains what was got if it does so in every case.
template <class Share>
Mistake shareMistake(const char* words, Share share) {
    return {
        words, [share] {
            for (const SplitCase& c : splitCases())
                if (std::abs(splitShare(1 / c.massA, c.contactsA, 1 / c.massB, c.contactsB) -
                             share(1.0 / c.massA, c.contactsA, 1.0 / c.massB, c.contactsB)) > 1e-5)
                    return false;
            return true;
        }};
}

inline void splitByHand(Report& report) {
    for (const SplitCase& c : splitCases())
        requireNear(report,
                    "share of balls of " + brief(c.massA) + " and " + brief(c.massB) + " kg with " +
                        brief(c.contactsA) + " and " + brief(c.contactsB) + " contacts",
                    splitShare(1 / c.massA, c.contactsA, 1 / c.massB, c.contactsB), c.share);
    using D = double;
    report.guess(
        {shareMistake("the whole masses: contacts are not counted", [](D, D, D, D) { return 1.0; }),
         shareMistake("the count of the first ball was used for both",
                      [](D a, D n, D b, D) { return (a + b) / (n * a + n * b); }),
         shareMistake("the counts were mixed up: each ball's mass goes with its own contacts",
                      [](D a, D n, D b, D m) { return (a + b) / (m * a + n * b); }),
         shareMistake("one over all contacts of both, whatever the masses",
                      [](D, D n, D, D m) { return 2 / (n + m); }),
         shareMistake("upside down: more contacts must leave each less",
                      [](D a, D n, D b, D m) { return (n * a + m * b) / (a + b); })});
    const Spheres row = summed(report.device, rowOf({1, 0, -2}), true);
    for (std::size_t k = 0; k < 3; ++k)
        requireNear(report, "row of 1, 0, -2 m/s: velocity of ball " + text(k),
                    double(row.velocities[k].x), k == 0 ? 1.0 / 3 : -2.0 / 3);
}

/// The plain sum with its shares is chapter 07's response, ball by ball.
inline void splitIsChapter07(Report& report) {
    for (const int count : {0, 1, 2, 33, 255, 256, 257, 1000}) {
        const Example scene = randomScene(count, report.seed + 3);
        const Spheres got = summed(report.device, scene, true);
        requireSameBalls(report, text(count) + " balls", got, oracle(scene, {.split = true}),
                         2e-4f);
        report.guess({{"masses are not split: a plain sum of impulses",
                       [&] { return haveVelocities(got, oracle(scene, {.split = false})); }}});
    }
}

inline void plainSum(Report& report) {
    const auto gain = [&](const Example& example, bool split) {
        return kineticEnergy(summed(report.device, example, split)) / kineticEnergy(example.balls);
    };
    for (const int k : {2, 3, 5})
        for (const float mass : {0.1f, 1.0f, 10.0f})
            for (const float e : {0.0f, 0.5f, 1.0f}) {
                const double S = k * 0.64, B = mass / (mass + 1.0);
                const Example cone = coneOf(k, 0.8, 1, mass, e);
                const std::string where = text(k) + " balls of " + brief(mass) + " kg at rest, e " +
                                          brief(e) + ": energy ";
                const double sum = truth::hubAndSpokesEnergy(e, S, B);
                requireNear(report, where + "after / before, plain sum", gain(cone, false), sum,
                            1e-4 * std::max(1.0, sum));
                const double split = gain(cone, true);
                if (!(split <= 1 + 1e-5))
                    report.fail(where + "after / before, split", text(float(split)), "at most 1");
            }
    for (const float e : {0.0f, 0.5f, 1.0f}) {
        const Example scene = randomScene(400, report.seed, e);
        const Spheres after = summed(report.device, scene, true);
        requireNear(report, "split, e " + brief(e) + ": momentum that came or went, kg m/s",
                    momentumBetween(scene.balls, after), 0, momentumTolerance(scene.balls, after));
        if (!(kineticEnergy(after) <= kineticEnergy(scene.balls) * (1 + 1e-6)))
            report.fail("split, e " + brief(e) + ": energy, J", text(float(kineticEnergy(after))),
                        "at most " + text(float(kineticEnergy(scene.balls))));
    }
    char words[160];
    std::snprintf(words, sizeof words,
                  "one ball into a pocket of three: energy x %.3f with a plain sum, x %.3f split, "
                  "x %.3f pair by pair",
                  gain(pocketOfThree(), false), gain(pocketOfThree(), true),
                  kineticEnergy(pairByPairOnce(report.device, pocketOfThree())) /
                      kineticEnergy(pocketOfThree().balls));
    report.measured(words);
}

}  // namespace ballpit::check
