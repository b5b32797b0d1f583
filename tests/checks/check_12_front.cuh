// Chapter 12's checks of the Pareto front: who beats whom, by hand; and the front of many points
// against a search that sorts them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "12_speed_and_accuracy/pareto_front.h"
#include "chapters/12_speed_and_accuracy/example.h"
#include "tests/checks/canvas.h"
#include "tests/checks/check_12_errors.cuh"

namespace ballpit::check {

using Points = std::vector<WorkPoint>;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();

/// "speed 4, error 0.2".
inline std::string words(const WorkPoint& point) {
    return "speed " + brief(point.speed) + ", error " + brief(point.error) +
           (point.failed ? ", failed" : "");
}

// ---- one against another

struct Meeting {
    WorkPoint a, b;
    bool aBeatsB;
};

inline void beatsByHand(Report& report) {
    const std::vector<Meeting> meetings{
        {{2, 0.1}, {1, 0.2}, true},        {{1, 0.2}, {2, 0.1}, false},
        {{2, 0.2}, {1, 0.1}, false},       {{1, 0.1}, {2, 0.2}, false},
        {{2, 0.1}, {1, 0.1}, true},        {{1, 0.1}, {2, 0.1}, false},
        {{1, 0.1}, {1, 0.2}, true},        {{1, 0.2}, {1, 0.1}, false},
        {{1, 0.1}, {1, 0.1}, false},       {{1, 0}, {1, 1e-300}, true},
        {{infinite, 0.1}, {9, 0.1}, true}, {{infinite, 0.1}, {infinite, 0.1}, false},
        {{1, 0.1}, {1, infinite}, true},   {{infinite, 0.2}, {1, 0.1}, false}};
    for (const auto& [a, b, expected] : meetings)
        if (dominates(a, b) != expected)
            report.fail("(" + words(a) + ") beats (" + words(b) + ")", text(!expected),
                        text(expected));
    const auto always = [&](auto rule) {
        return [&meetings, rule] {
            return std::all_of(meetings.begin(), meetings.end(), [&](const Meeting& m) {
                return dominates(m.a, m.b) == rule(m.a, m.b);
            });
        };
    };
    using P = const WorkPoint&;
    report.guess(
        {{"equal points beat each other: neither may",
          always([](P a, P b) { return a.speed >= b.speed && a.error <= b.error; })},
         {"better in both is asked for: equal in one and better in the other is enough",
          always([](P a, P b) { return a.speed > b.speed && a.error < b.error; })},
         {"better in one is taken for enough, however much worse in the other",
          always([](P a, P b) { return a.speed > b.speed || a.error < b.error; })},
         {"a large error is taken for the better one", always([](P a, P b) {
              return a.speed >= b.speed && a.error >= b.error &&
                     (a.speed > b.speed || a.error > b.error);
          })},
         {"only the speed is compared", always([](P a, P b) { return a.speed > b.speed; })},
         {"only the error is compared", always([](P a, P b) { return a.error < b.error; })}});
}

// ---- the front

/// The slow way's opposite: by falling speed, a point is on the front if its error is below all of
/// those that are faster, and the lowest at its own speed. Knows nothing of who beats whom.
inline std::vector<bool> frontBySorting(const Points& points) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (!points[k].failed && points[k].error == points[k].error &&
            points[k].speed == points[k].speed)
            order.push_back(k);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const WorkPoint &p = points[a], &q = points[b];
        return p.speed != q.speed ? p.speed > q.speed : p.error < q.error;
    });
    std::vector<bool> front(points.size(), false);
    double best = infinite;
    bool isFirst = true;
    for (std::size_t from = 0; from < order.size();) {
        const WorkPoint& leader = points[order[from]];
        std::size_t to = from;
        while (to < order.size() && points[order[to]].speed == leader.speed) ++to;
        for (std::size_t k = from; k < to; ++k)
            front[order[k]] =
                points[order[k]].error == leader.error && (isFirst || leader.error < best);
        best = std::min(best, leader.error);
        isFirst = false;
        from = to;
    }
    return front;
}

/// The front as someone makes it with a mistake: which points are shown, which can beat others, and
/// whether a large error counts as the better one.
struct FrontMistake {
    const char* words;
    bool showsFailed, showsNaN, failedBeat, largeIsBetter;

    std::vector<bool> front(const Points& points) const {
        std::vector<bool> front;
        for (const WorkPoint& p : points)
            front.push_back(isShown(p) && std::none_of(points.begin(), points.end(),
                                                       [&](auto& q) { return beats(q, p); }));
        return front;
    }

private:
    bool isShown(const WorkPoint& p) const {
        return (showsFailed || !p.failed) && (showsNaN || !std::isnan(p.error));
    }
    bool beats(const WorkPoint& q, const WorkPoint& p) const {
        const double mine = largeIsBetter ? -q.error : q.error,
                     other = largeIsBetter ? -p.error : p.error;
        return (failedBeat || !q.failed) && q.speed >= p.speed && mine <= other &&
               (q.speed > p.speed || mine < other);
    }
};

/// What these points can tell apart.
inline void guessFront(Report& report, const Points& points) {
    const std::vector<bool> got = paretoFront(points);
    std::vector<Mistake> mistakes{{"every run with a result is on it: nobody was compared", [&] {
                                       std::vector<bool> all;
                                       for (const WorkPoint& p : points)
                                           all.push_back(!p.failed && !std::isnan(p.error));
                                       return got == all;
                                   }}};
    const char* early = "failed runs are on it: a run that broke off early is fast";
    for (const FrontMistake& mistake :
         {FrontMistake{"a run whose error is NaN is on it: nothing is smaller than NaN", false,
                       true, false, false},
          FrontMistake{early, true, true, true, false},
          FrontMistake{early, true, false, true, false},
          FrontMistake{early, true, true, false, false},
          FrontMistake{"failed runs beat others: what broke off early cannot beat anyone", false,
                       false, true, false},
          FrontMistake{"a large error is taken for the better one", false, false, false, true}})
        mistakes.push_back(
            {mistake.words, [&points, &got, mistake] { return got == mistake.front(points); }});
    report.guess(mistakes);
}

inline bool requireFront(Report& report, const std::string& where, const Points& points,
                         const std::vector<bool>& expected) {
    const std::vector<bool> got = paretoFront(points);
    if (got.size() != expected.size()) {
        report.fail(where + ": number of answers", text(got.size()), text(expected.size()));
        return false;
    }
    for (std::size_t k = 0; k < points.size(); ++k)
        if (got[k] != expected[k])
            report.fail(where + ", point " + text(k) + " (" + words(points[k]) + ") on the front",
                        text(bool(got[k])), text(bool(expected[k])));
    if (report.failed()) guessFront(report, points);
    return !report.failed();
}

inline void frontByHand(Report& report) {
    requireFront(report, "no point", {}, {});
    requireFront(report, "one point", {{1, 0.1}}, {true});
    requireFront(report, "two, one better in both", {{1, 0.2}, {2, 0.1}}, {false, true});
    requireFront(report, "two, each better in one", {{1, 0.1}, {2, 0.2}}, {true, true});
    requireFront(report, "two equal ones", {{1, 0.1}, {1, 0.1}}, {true, true});
    requireFront(report, "equally fast", {{1, 0.1}, {1, 0.2}, {1, 0.3}}, {true, false, false});
    requireFront(report, "equally exact", {{1, 0.1}, {2, 0.1}, {3, 0.1}}, {false, false, true});
    requireFront(report, "no pair was visited", {{infinite, 0.1}, {5, 0.1}, {5, 0.01}},
                 {true, false, true});
    Points eight;
    std::vector<bool> expected;
    for (const ExamplePoint& point : examplePoints()) {
        eight.push_back(point.work());
        expected.push_back(point.isOnFront);
    }
    requireFront(report, "the lesson's example", eight, expected);
}

inline void failedRuns(Report& report) {
    requireFront(report, "one failed run", {{1, 0.1, true}}, {false});
    requireFront(report, "a failed run is faster and nearer", {{9, 0.001, true}, {1, 0.1}},
                 {false, true});
    requireFront(report, "nothing but failed runs", {{1, 0.1, true}, {2, 0.2, true}},
                 {false, false});
    requireFront(report, "an error that is no number", {{9, noNumber}, {1, 0.1}}, {false, true});
    requireFront(report, "failed, and no number", {{9, noNumber, true}, {1, 0.1}, {2, 0.2}},
                 {false, true, true});
    requireFront(report, "a speed that is no number", {{noNumber, 0.01}, {1, 0.1}}, {false, true});
}

/// Points on a coarse lattice, so that many share a speed or an error. Every seventh failed, soon:
/// its error had no time to grow.
inline Points randomPoints(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    Points points;
    for (std::size_t k = 0; k < count; ++k) {
        const float fast = random.uniform(0.1f, 1);  // who is faster is less exact
        const double speed = std::floor(40 * fast) / 4,
                     error = std::floor(random.uniform(40 * fast * fast, 60)) / 100;
        const bool failed = k % 7 == 3;
        points.push_back({speed, failed ? error / 8 : error, failed});
    }
    return points;
}

/// Yours, the reference's, and in red where they differ: up is more exact, right is faster.
inline Frame drawFront(const Points& points, const std::vector<bool>& right) {
    const std::vector<bool> got = paretoFront(points);
    return threePanels(0, 0, 10.5f, 300, [&](Canvas& canvas, const Panel& panel, int part) {
        for (std::size_t k = 0; k < points.size() && k < got.size(); ++k) {
            const float x = panel.x(static_cast<float>(points[k].speed)),
                        y = panel.y(10.3f - 16.5f * static_cast<float>(points[k].error));
            const bool isOn = part == 0 ? got[k] : right[k];
            const bool isWrong = part == 2 && got[k] != right[k];
            canvas.disc(x, y, isOn || isWrong ? 7 : 4,
                        isWrong            ? colors::red
                        : part == 2        ? colors::line
                        : isOn             ? colors::blue
                        : points[k].failed ? colors::ink
                                           : colors::grey);
        }
    });
}

inline void frontAtRandom(Report& report) {
    const Points drawn = randomPoints(60, report.seed + 20);
    if (!requireFront(report, "60 points", drawn, frontBySorting(drawn)))
        return report.picture([&] { return drawFront(drawn, frontBySorting(drawn)); });
    for (const std::size_t count : {0, 1, 2, 33, 255, 256, 257, 1000})
        for (std::uint64_t k = 0; k < 10; ++k) {
            const Points points = randomPoints(count, report.seed + 21 + k);
            requireFront(report, text(count) + " points, seed " + text(report.seed + 21 + k),
                         points, frontBySorting(points));
        }
}

/// Neither the order of the points nor the units of the axes matter.
inline void frontInAnyOrder(Report& report) {
    Points points = randomPoints(257, report.seed + 40);
    std::vector<bool> front = paretoFront(points);
    const auto onFront = [&] { return std::count(front.begin(), front.end(), true); };
    if (onFront() == 0) report.fail("257 points: on the front", "none", "at least one");
    Points backwards(points.rbegin(), points.rend()), scaled = points;
    for (WorkPoint& point : scaled)
        point = {std::log(point.speed) - 5, point.error * 360, point.failed};
    const std::vector<bool> reversed(front.rbegin(), front.rend());
    requireFront(report, "257 points, the last first", backwards, reversed);
    requireFront(report, "257 points, logarithm of speed, error in degrees", scaled, front);
}

}  // namespace ballpit::check
