// What chapter 01's checks are made of: the search on a device, an oracle that sweeps along x (it
// shares neither loop nor formula with the piece), and how a difference is told and shown.
#pragma once

#include "01_naive_collision/naive_collision.cuh"

#include <algorithm>
#include <numeric>

#include "common/random.h"
#include "tests/checks/canvas.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

using Balls = std::vector<Vec4>;  // x, y, z, radius in m

inline Pair pair(std::size_t a, std::size_t b) {
    return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)};
}

inline std::vector<Pair> sorted(std::vector<Pair> pairs) {
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

// ---- the piece on a device

/// What a search leaves behind.
struct Found {
    std::uint32_t count = 0;   ///< pairs counted
    std::vector<Pair> stored;  ///< the places that were to be written, sorted
    bool wroteBeyond = false;  ///< something behind the list has changed
    bool operator==(const Found&) const = default;
};

constexpr Pair untouched{0xFFFFFFFFu, 0xFFFFFFFFu};

/// Arrays that are used again and again, as an engine does: each search finds what the one before
/// it has left. Behind the balls lie others that touch everything, so that a thread or a loop that
/// goes too far is seen.
class Workplace {
public:
    explicit Workplace(Device device, std::size_t capacity = 30000)
        : device_(device),
          positions_(device, places, "positions"),
          pairs_(device, capacity, "pairs"),
          found_(device, 1, "found") {}

    /// Searches with a list that is `capacity` long; by default all there is.
    Found search(const Balls& balls, std::uint32_t capacity = 0xFFFFFFFFu) {
        Balls all = balls;
        all.resize(places, Vec4{0, 0, 0, 1e6f});
        positions_.upload(all);
        found_.fill(0);
        View<Pair> list = pairs_.view();
        list.count = std::min(list.count, capacity);
        const std::vector<Pair> before = pairs_.download();
        launchFindPairsNaive(device_, static_cast<int>(balls.size()), positions_.view(), list,
                             found_.view());
        const std::vector<Pair> after = pairs_.download();
        Found result;
        result.count = found_.download()[0];
        const auto end = static_cast<std::ptrdiff_t>(std::min(result.count, list.count));
        result.stored = sorted({after.begin(), after.begin() + end});
        result.wroteBeyond = !std::equal(after.begin() + end, after.end(), before.begin() + end);
        return result;
    }

private:
    static constexpr std::size_t places = 6000;
    Device device_;
    DeviceBuffer<Vec4> positions_;
    DeviceBuffer<Pair> pairs_;
    DeviceBuffer<std::uint32_t> found_;
};

// ---- what is right

/// How two balls are compared: the right rule, and those of the classic mistakes.
using Rule = bool (*)(Vec4 a, Vec4 b);

inline float squaredDistance(Vec4 a, Vec4 b) {
    const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
    return dx * dx + dy * dy + dz * dz;
}
inline bool rightRule(Vec4 a, Vec4 b) { return squaredDistance(a, b) < (a.w + b.w) * (a.w + b.w); }
inline bool ownRadius(Vec4 a, Vec4 b) { return squaredDistance(a, b) < a.w * a.w; }
inline bool otherRadius(Vec4 a, Vec4 b) { return squaredDistance(a, b) < b.w * b.w; }
inline bool radiiSquared(Vec4 a, Vec4 b) { return squaredDistance(a, b) < a.w * a.w + b.w * b.w; }
inline bool notSquared(Vec4 a, Vec4 b) { return squaredDistance(a, b) < a.w + b.w; }
inline bool rootForgotten(Vec4 a, Vec4 b) {
    return std::sqrt(squaredDistance(a, b)) < (a.w + b.w) * (a.w + b.w);
}
inline bool alsoAtContact(Vec4 a, Vec4 b) {
    return squaredDistance(a, b) <= (a.w + b.w) * (a.w + b.w);
}

/// All pairs that touch: balls sorted by where they begin along x; behind the end of one, no
/// further one can touch it.
inline std::vector<Pair> sweptPairs(const Balls& balls) {
    constexpr float slack = 1e-3f;  // m; more than rounding moves an end
    std::vector<std::size_t> byStart(balls.size());
    std::iota(byStart.begin(), byStart.end(), std::size_t{0});
    const auto start = [&](std::size_t k) { return balls[k].x - balls[k].w; };
    std::sort(byStart.begin(), byStart.end(),
              [&](std::size_t a, std::size_t b) { return start(a) < start(b); });
    std::vector<Pair> pairs;
    for (std::size_t m = 0; m < byStart.size(); ++m) {
        const Vec4 ball = balls[byStart[m]];
        for (std::size_t n = m + 1; n < byStart.size(); ++n) {
            if (start(byStart[n]) > ball.x + ball.w + slack) break;
            const auto [a, b] = std::minmax(byStart[m], byStart[n]);
            if (rightRule(balls[a], balls[b])) pairs.push_back(pair(a, b));
        }
    }
    return sorted(pairs);
}

/// What a wrong rule finds.
inline std::vector<Pair> pairsBy(Rule rule, const Balls& balls) {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < balls.size(); ++a)
        for (std::size_t b = a + 1; b < balls.size(); ++b)
            if (rule(balls[a], balls[b])) pairs.push_back(pair(a, b));
    return pairs;
}

inline Balls scattered(int count, Bounds box, std::uint64_t seed) {
    Random random(seed);
    Balls balls;
    for (int k = 0; k < count; ++k) {
        const Vec3 place = random.uniformIn(box);
        balls.push_back(withW(place, random.uniform(0.1f, 0.5f)));
    }
    return balls;
}

// ---- how a difference is told and shown

inline std::string describe(const Balls& balls, Pair p) {
    if (p.first >= balls.size() || p.second >= balls.size())
        return ", but there are only " + text(balls.size()) + " balls";
    const Vec4 a = balls[p.first], b = balls[p.second];
    return ", " + text(std::sqrt(squaredDistance(a, b))) + " m apart, radii " + text(a.w) +
           " and " + text(b.w);
}

inline void guessMistake(Report& report, const Balls& balls, const std::vector<Pair>& got) {
    const std::vector<Pair> right = sweptPairs(balls);
    const auto rule = [&](Rule wrong) {
        return [&, wrong] { return got == pairsBy(wrong, balls); };
    };
    const auto any = [&](auto claim) { return std::any_of(got.begin(), got.end(), claim); };
    const std::size_t whole = balls.size() / threadsPerBlock * threadsPerBlock;
    report.guess({
        {"a ball compared with itself: j must stop before i",
         [&] { return any([](Pair p) { return p.first == p.second; }); }},
        {"threads without a ball took part: the guard is missing or lets one too many pass",
         [&] { return any([&](Pair p) { return p.second >= balls.size(); }); }},
        {"each pair in both orders: a ball must only look at those before it",
         [&] {
             return got.size() == 2 * right.size() &&
                    any([](Pair p) { return p.second < p.first; });
         }},
        {"the larger number first",
         [&] { return !got.empty() && !any([](Pair p) { return p.first < p.second; }); }},
        {"only one of the two radii: balls touch at the sum of both", rule(ownRadius)},
        {"only one of the two radii: balls touch at the sum of both", rule(otherRadius)},
        {"radii squared one by one: the sum must be squared as a whole", rule(radiiSquared)},
        {"a squared distance compared with a distance: square the sum of the radii, too",
         rule(notSquared)},
        {"a block count rounded down: the balls of the last, half-filled block have no thread",
         [&] {
             std::vector<Pair> inWholeBlocks;
             for (const Pair p : right)
                 if (p.second < whole) inWholeBlocks.push_back(p);
             return got == inWholeBlocks;
         }},
    });
}

/// Yours, reference, errors: seen from above. Touching balls are blue and joined by a line.
inline Frame drawPairs(const Balls& balls, float side, const std::vector<Pair>& got,
                       const std::vector<Pair>& expected) {
    std::vector<Pair> wrong;  // listed too often, too rarely, or not at all in one of the two
    std::set_symmetric_difference(got.begin(), got.end(), expected.begin(), expected.end(),
                                  std::back_inserter(wrong));
    const std::vector<Pair>* lists[] = {&got, &expected, &wrong};
    return threePanels(0, 0, side, 300, [&](Canvas& canvas, const Panel& panel, int k) {
        const Vec3 color = k < 2 ? colors::blue : colors::red;
        std::vector<Vec3> ballColors(balls.size(), colors::grey);
        for (const Pair p : *lists[k])
            for (const std::uint32_t ball : {p.first, p.second})
                if (ball < balls.size()) ballColors[ball] = color;
        for (std::size_t i = 0; i < balls.size(); ++i)
            canvas.disc(panel.x(balls[i].x), panel.y(balls[i].z), panel.scale * balls[i].w,
                        ballColors[i]);
        for (const Vec4 ball : balls)
            canvas.ring(panel.x(ball.x), panel.y(ball.z), panel.scale * ball.w, 1.0f,
                        colors::paper);
        for (const Pair p : *lists[k])
            if (p.first < balls.size() && p.second < balls.size())
                canvas.line(panel.x(balls[p.first].x), panel.y(balls[p.first].z),
                            panel.x(balls[p.second].x), panel.y(balls[p.second].z), 1.5f,
                            colors::ink);
    });
}

/// The claim that most checks share.
inline void requireRightPairs(Report& report, const Balls& balls, const Found& found) {
    const std::vector<Pair> expected = sweptPairs(balls);
    if (!samePairs(report, found.stored, expected, [&](Pair p) { return describe(balls, p); }))
        guessMistake(report, balls, found.stored);
    if (found.count != found.stored.size())
        report.fail("pairs counted", text(found.count), text(expected.size()));
    if (found.wroteBeyond) report.fail("places behind the last pair were written to");
}

}  // namespace ballpit::check
