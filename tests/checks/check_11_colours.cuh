// Chapter 11's checks of the colouring: by hand, one round, against one thread that takes the pairs
// in order, with hubs.
#pragma once

#include <map>
#include <set>

#include "tests/checks/canvas.h"
#include "tests/checks/check_11_sums.cuh"

namespace ballpit::check {

/// Pairs of balls that need no place; coloured in rounds, as a GPU does it.
class Coloured {
public:
    Coloured(Device device, std::size_t bodies, const std::vector<Pair>& pairs)
        : device_(device),
          round_(device, standing(bodies), pairs),
          colouring_(device, bodies, pairs.size()) {
        colouring_.colour(round_.round().pairs, true);
        view_ = colouring_.view();
        pairs_ = fetched(view_.pairs.pairs);
    }

    const std::vector<Pair>& pairs() const { return pairs_; }  ///< in the order of their numbers
    const ColouringView& view() const { return view_; }
    std::vector<std::uint32_t> colours() const { return fetched(view_.colours); }

    template <class T>
    std::vector<T> fetched(const View<T>& view) const {
        std::vector<T> host(view.count);
        copyToHost(device_, host.data(), view.data, view.count * sizeof(T));
        return host;
    }

    /// Forgets all colours and runs so many rounds, the last one without its second half if `bids`.
    void rounds(int count, bool bids = false) {
        const int threads = round_.round().bodyCount;
        launch<clearBodyColours>(device_, threads, view_);
        launch<clearPairColours>(device_, threads, threads, view_);
        for (int k = 0; k < count; ++k) {
            launch<bidForColour>(device_, threads, threads, view_);
            if (!bids || k + 1 < count) launch<takeColour>(device_, threads, threads, view_);
        }
    }

    /// How often each pair is visited by what runs over all colours.
    std::vector<std::uint32_t> visits();

private:
    static Spheres standing(std::size_t count) {
        Spheres balls;
        for (std::size_t k = 0; k < count; ++k) balls.add({}, {}, 0.5f, 1.0f, 1.0f);
        return balls;
    }

    Device device_;
    OneRound round_;
    Colouring colouring_;
    ColouringView view_;
    std::vector<Pair> pairs_;
};

HD inline void countVisit(std::uint32_t k, View<std::uint32_t> visits) { ++visits[k]; }

inline std::vector<std::uint32_t> Coloured::visits() {
    DeviceBuffer<std::uint32_t> visits(device_, pairs_.size(), "visits");
    visits.fill(0);
    colouring_.forEachPair<countVisit>(visits.view());
    return visits.download();
}

/// The pairs' numbers in order of their priority.
inline std::vector<std::uint32_t> inOrder(std::size_t count) {
    const PriorityHash hash = PriorityHash::forCount(static_cast<std::uint32_t>(count));
    std::vector<std::uint32_t> order;
    for (std::uint32_t k = 0; k < count; ++k) order.push_back(k);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return hash.priorityOf(a) < hash.priorityOf(b);
    });
    return order;
}

/// How the oracle gives colours. All but the first are mistakes.
enum class Giving { right, greatestFirst, asListed, marksFirstOnly, looksAtFirstOnly };

/// What one thread gives that takes the pairs in order: sets of colours, no bits. Each body has
/// fewer pairs than there are rounds, or all that is left overflows anyway.
inline std::vector<std::uint32_t> coloursOneByOne(const std::vector<Pair>& pairs,
                                                  Giving giving = Giving::right) {
    std::vector<std::uint32_t> order = inOrder(pairs.size()), colours(pairs.size(), noColour);
    if (giving == Giving::greatestFirst) std::reverse(order.begin(), order.end());
    if (giving == Giving::asListed) std::sort(order.begin(), order.end());
    std::map<std::uint32_t, std::set<std::uint32_t>> used;
    for (const std::uint32_t k : order) {
        const auto [a, b] = pairs[k];
        std::uint32_t colour = 0;
        while (used[a].count(colour) ||
               (giving != Giving::looksAtFirstOnly && used[b].count(colour)))
            ++colour;
        colours[k] = std::min(colour, overflowColour);
        used[a].insert(colour);
        if (giving != Giving::marksFirstOnly) used[b].insert(colour);
    }
    return colours;
}

inline void guessColours(Report& report, const Coloured& got) {
    const auto like = [&](Giving giving) {
        return [&got, giving] { return got.colours() == coloursOneByOne(got.pairs(), giving); };
    };
    report.guess(
        {{"no pair gets a colour: all are left over, for one thread",
          [&] {
              const auto colours = got.colours();
              return std::all_of(colours.begin(), colours.end(),
                                 [](std::uint32_t c) { return c >= overflowColour; });
          }},
         {"the greatest priority wins; it is the smallest", like(Giving::greatestFirst)},
         {"a colour is marked as used at the pair's first ball only", like(Giving::marksFirstOnly)},
         {"only the first ball was asked which colours are free", like(Giving::looksAtFirstOnly)},
         {"the pairs went by their numbers, not by their priorities", like(Giving::asListed)},
         {"pairs are left over that could have a colour: their bids never win", [&] {
              const auto colours = got.colours(), right = coloursOneByOne(got.pairs());
              for (std::size_t k = 0; k < right.size(); ++k)
                  if (colours[k] >= overflowColour && right[k] < overflowColour) return true;
              return false;
          }}});
}

/// Compares every pair's colour with the oracle's.
inline void requireColours(Report& report, const std::string& where, const Coloured& got) {
    const std::vector<std::uint32_t> colours = got.colours();
    const std::vector<std::uint32_t> expected = coloursOneByOne(got.pairs());
    for (std::size_t k = 0; k < expected.size(); ++k)
        if (colours[k] != expected[k])
            report.fail(where + ": colour of pair " + text(got.pairs()[k]), text(colours[k]),
                        text(expected[k]));
    guessColours(report, got);
}

/// Where all pairs share a ball, the k-th by priority gets colour k; where none do, all get 0.
inline void coloursByHand(Report& report) {
    struct Case {
        const char* name;
        std::size_t balls;
        std::vector<Pair> pairs;
        bool allMeet;
    };
    for (const Case& c :
         {Case{"no pair", 2, {}, true}, Case{"one pair", 2, {{0, 1}}, true},
          Case{"a row of three", 3, {{0, 1}, {1, 2}}, true},
          Case{"a triangle", 3, {{0, 1}, {0, 2}, {1, 2}}, true},
          Case{"a star of five, hub last", 6, {{0, 5}, {1, 5}, {2, 5}, {3, 5}, {4, 5}}, true},
          Case{"a star of three, hub first", 4, {{0, 1}, {0, 2}, {0, 3}}, true},
          Case{"three pairs apart", 6, {{0, 1}, {2, 3}, {4, 5}}, false}}) {
        const Coloured got(report.device, c.balls, c.pairs);
        const std::vector<std::uint32_t> order = inOrder(c.pairs.size()), colours = got.colours();
        for (std::uint32_t rank = 0; rank < order.size(); ++rank) {
            const std::uint32_t expected = c.allMeet ? rank : 0, k = order[rank];
            if (colours[k] != expected)
                report.fail(std::string(c.name) + ": colour of pair " + text(got.pairs()[k]),
                            text(colours[k]), text(expected));
        }
        guessColours(report, got);
    }
}

/// One round by itself: the bids, and who takes a colour.
inline void oneColouringRound(Report& report) {
    const Example scene = randomScene(200, report.seed + 6);
    Coloured all(report.device, scene.balls.count(), scene.pairs);
    const std::vector<Pair>& pairs = all.pairs();
    const PriorityHash hash = PriorityHash::forCount(static_cast<std::uint32_t>(pairs.size()));
    constexpr std::uint32_t none = 0xFFFFFFFFu;
    std::vector<std::uint32_t> best(scene.balls.count(), none);
    for (std::uint32_t k = 0; k < pairs.size(); ++k)
        for (const std::uint32_t body : {pairs[k].first, pairs[k].second})
            best[body] = std::min(best[body], hash.priorityOf(k));
    all.rounds(1, true);
    const std::vector<std::uint32_t> bids = all.fetched(all.view().best);
    for (std::size_t body = 0; body < best.size(); ++body)
        if (bids[body] != best[body])
            report.fail("after the bids: the best at ball " + text(body), text(bids[body]),
                        text(best[body]));
    all.rounds(1);
    const std::vector<std::uint32_t> colours = all.colours(), left = all.fetched(all.view().best);
    bool tookTooMany = false;
    for (std::uint32_t k = 0; k < pairs.size(); ++k) {
        const auto [a, b] = pairs[k];
        const bool wins = best[a] == hash.priorityOf(k) && best[b] == hash.priorityOf(k);
        tookTooMany |= !wins && colours[k] != noColour;
        if (wins != (colours[k] != noColour))
            report.fail("after one round: pair " + text(pairs[k]) + " has a colour",
                        text(colours[k] != noColour), text(wins));
        if (wins && (left[a] != none || left[b] != none))
            report.fail(
                "the bids at the balls of pair " + text(pairs[k]) + ", which took its colour",
                "still there", "cleared for the next round");
    }
    report.guess({{"a pair took its colour that came first at one of its balls only",
                   [&] { return tookTooMany; }}});
}

inline std::vector<Pair> star(std::uint32_t spokes) {
    std::vector<Pair> pairs;
    for (std::uint32_t k = 0; k < spokes; ++k) pairs.push_back({k, spokes});
    return pairs;
}

/// No colour holds two pairs of one ball, and every pair is visited once.
inline void properColours(Report& report) {
    const auto require = [&](const std::string& where, std::size_t bodies,
                             const std::vector<Pair>& pairs) {
        Coloured got(report.device, bodies, pairs);
        const std::vector<std::uint32_t> colours = got.colours(), visits = got.visits();
        std::set<std::pair<std::uint32_t, std::uint32_t>> taken;
        for (std::size_t k = 0; k < colours.size(); ++k) {
            const Pair pair = got.pairs()[k];
            for (const std::uint32_t body : {pair.first, pair.second})
                if (colours[k] < overflowColour && !taken.insert({body, colours[k]}).second)
                    report.fail(where + ": ball " + text(body) + " has two pairs of one colour",
                                text(pair) + " as well", "one pair a colour");
            if (visits[k] != 1)
                report.fail(where + ": visits to pair " + text(pair), text(visits[k]), "1");
        }
    };
    for (const int count : {0, 1, 2, 33, 255, 256, 257, 1000}) {
        const Example scene = randomScene(count, report.seed + 7);
        require(text(count) + " balls", scene.balls.count(), scene.pairs);
    }
    require("a hub of 60", 61, star(60));
}

/// A hub has more pairs than there are colours: what is left over goes to one thread.
inline void hubOverflows(Report& report) {
    const Coloured hub(report.device, 61, star(60));
    const std::vector<std::uint32_t> colours = hub.colours(), order = inOrder(60);
    for (std::uint32_t rank = 0; rank < 60; ++rank) {
        const std::uint32_t expected = std::min(rank, overflowColour), k = order[rank];
        if (std::min(colours[k], overflowColour) != expected)
            report.fail("a hub of 60: colour of its pair " + text(hub.pairs()[k]), text(colours[k]),
                        text(expected));
    }
    guessColours(report, hub);
}

// ---- pictures: balls in a layer, a line for each contact

inline Example layer(std::uint64_t seed) {
    Random random(seed);
    Example example;
    for (int k = 0; k < 36; ++k) {
        const Vec3 jitter = random.uniformIn({{-0.12f, -0.12f, 0}, {0.12f, 0.12f, 0}});
        const float row = static_cast<float>(k / 6);
        example.balls.add(
            Vec3{static_cast<float>(k % 6) + 0.5f * static_cast<float>(k / 6 % 2), 0.87f * row, 0} +
                jitter,
            {}, 0.5f, 1, 1);
    }
    example.pairs = findPairsOnHost(example.balls);
    return example;
}

inline Vec3 colourOfPair(std::uint32_t colour) {
    constexpr Vec3 palette[] = {{0.00f, 0.45f, 0.70f}, {0.90f, 0.62f, 0.00f}, {0.00f, 0.62f, 0.45f},
                                {0.80f, 0.47f, 0.65f}, {0.34f, 0.71f, 0.91f}, {0.94f, 0.89f, 0.26f},
                                {0.35f, 0.30f, 0.25f}};
    return colour >= overflowColour ? colors::ink : palette[colour % 7];
}

/// The colours of all contacts: yours, the reference's; at last, in red, contacts of one colour
/// that meet at a ball, and in ink what differs otherwise.
inline Frame drawColours(const Example& scene, const Coloured& got) {
    const std::vector<std::uint32_t> yours = got.colours(), right = coloursOneByOne(got.pairs());
    const auto clashes = [&](std::size_t k) {
        for (std::size_t other = 0; other < yours.size(); ++other) {
            const Pair p = got.pairs()[k], q = got.pairs()[other];
            const bool meet = p.first == q.first || p.first == q.second || p.second == q.first ||
                              p.second == q.second;
            if (other != k && meet && yours[k] == yours[other] && yours[k] < overflowColour)
                return true;
        }
        return false;
    };
    return threePanels(-0.9f, -1.2f, 7.3f, 300, [&](Canvas& canvas, const Panel& panel, int part) {
        for (const Vec3 p : scene.balls.positions)
            canvas.disc(panel.x(p.x), panel.y(p.y), panel.scale * 0.42f, colors::line);
        for (std::size_t k = 0; k < yours.size(); ++k) {
            const Vec3 a = scene.balls.positions[got.pairs()[k].first];
            const Vec3 b = scene.balls.positions[got.pairs()[k].second];
            Vec3 color = colourOfPair(part == 0 ? yours[k] : right[k]);
            if (part == 2) {
                if (yours[k] == right[k]) continue;
                color = clashes(k) ? colors::red : colors::ink;
            }
            canvas.line(panel.x(a.x), panel.y(a.y), panel.x(b.x), panel.y(b.y), 5.0f, color);
        }
    });
}

inline void coloursInRounds(Report& report) {
    const Example flat = layer(report.seed);
    const Coloured drawn(report.device, flat.balls.count(), flat.pairs);
    requireColours(report, "a layer of 36 balls", drawn);
    if (report.failed()) return report.picture([&] { return drawColours(flat, drawn); });
    for (const int count : {33, 255, 256, 257, 1000}) {
        const Example scene = randomScene(count, report.seed + 8);
        requireColours(report, text(count) + " balls",
                       Coloured(report.device, scene.balls.count(), scene.pairs));
    }
}

inline void sameColoursInEveryOrder(Report& report) {
    const Example scene = randomScene(6000, report.seed + 9);
    inEveryOrder(report, [&] {
        return Coloured(report.device, scene.balls.count(), scene.pairs).colours();
    });
}

/// Pair by pair: energy and momentum as in each single contact.
inline void pairByPair(Report& report) {
    for (const float e : {0.0f, 0.5f, 1.0f}) {
        const Example scene = randomScene(1000, report.seed + 10, e);
        const Spheres after = pairByPairOnce(report.device, scene);
        const double before = kineticEnergy(scene.balls), now = kineticEnergy(after);
        const std::string where = "1000 balls, e " + brief(e) + ": ";
        requireNear(report, where + "momentum that came or went, kg m/s",
                    momentumBetween(scene.balls, after), 0, momentumTolerance(scene.balls, after));
        if (!(now <= before * (1 + 1e-5)))
            report.fail(where + "energy, J", text(float(now)), "at most " + text(float(before)));
        if (e == 1) requireNear(report, where + "energy / before", now / before, 1, 1e-5);
    }
}

}  // namespace ballpit::check
