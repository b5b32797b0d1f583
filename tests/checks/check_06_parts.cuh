// Chapter 06: the parts of the search one by one, on a handful of balls: visit, count, report,
// write, and the three of them in a row.
#pragma once

#include "tests/checks/check_06_scenes.cuh"

namespace ballpit::check {

/// Writes down who is visited. A function object, since CUDA's compiler wants to see its HD.
struct Notebook {
    View<std::uint32_t> visited, count;
    HD void operator()(std::uint32_t j) const {
        if (count[0] < visited.count) visited[count[0]] = j;
        ++count[0];
    }
};

inline Words visitedBy(int i, Ground& ground) {
    DeviceBuffer<std::uint32_t> visited(Device::cpu, 1000, "visited");
    auto count = uploaded(Device::cpu, Words{0}, "count");
    visitPartnersAfter(i, ground.grid.view(), ground.grid.sortedHashes(), ground.positions(),
                       Notebook{visited.view(), count.view()});
    return visited.download(std::min<std::size_t>(count.download()[0], 1000));
}

inline void visits(Report& report) {
    const Bounds box{{-1.5f, -1.5f, -1.5f}, {1.5f, 1.5f, 1.5f}};
    for (const Scene06& scene :
         {fiveBalls,
          Scene06{"33 balls in 27 cells", scattered(33, box, 0.3f, 0.5f, report.seed), box}}) {
        Ground ground(Device::cpu, scene);
        const Pairs right = touchingPairs(ground.balls);
        Pairs got;
        for (int i = 0; i < ground.grid.count(); ++i) {
            Words expected;
            for (const Pair p : right)
                if (p.first == static_cast<std::uint32_t>(i)) expected.push_back(p.second);
            const Words visited = visitedBy(i, ground);
            for (const std::uint32_t j : visited) got.push_back({static_cast<std::uint32_t>(i), j});
            if (visited == expected) continue;
            const auto inWords = [](const Words& slots) {
                std::string words;
                for (const std::uint32_t j : slots) words += (words.empty() ? "" : ", ") + text(j);
                return slots.empty() ? "nobody" : words;
            };
            report.fail(scene.name + ": slots visited by ball " + text(i), inWords(visited),
                        inWords(expected));
        }
        if (report.failed()) return guessMistake(report, ground, got, right);
    }
}

/// Counts the partners of the first `launched` balls alone. All other places hold a mark, and so do
/// eight more behind the last ball's: whoever writes there is seen.
inline void requireCounts(Report& report, const Scene06& scene, std::size_t launched) {
    constexpr std::uint32_t mark = 0xABABABABu;
    Ground ground(report.device, scene);
    const std::size_t count = ground.balls.size(), places = (count + 1) * rememberedPartners;
    auto counts = uploaded(report.device, Words(count, mark), "counts");
    auto remembered = uploaded(report.device, Words(places, mark), "remembered");
    launch<broadPhaseCollision>(report.device, static_cast<int>(launched), ground.grid.view(),
                                ground.grid.sortedHashes(), ground.positions(), counts.view(),
                                remembered.view());
    Words expectedCounts(count, mark), expected(places, mark);
    std::fill_n(expectedCounts.begin(), launched, 0);
    for (const Pair p : touchingPairs(ground.balls)) {
        if (p.first >= launched) continue;
        const std::uint32_t k = expectedCounts[p.first]++;
        if (k < rememberedPartners) expected[p.first * rememberedPartners + k] = p.second;
    }
    const std::string where = scene.name + (launched < count ? ", ball 0 alone: " : ": ");
    const Words got = counts.download(), stored = remembered.download();
    sameElements(report, got, expectedCounts,
                 [&](std::size_t k) { return where + "partners after ball " + text(k); });
    bool wroteBeyond = false;
    for (std::size_t k = 0; k < places; ++k) {
        if (stored[k] == expected[k]) continue;
        const std::size_t ball = k / rememberedPartners;
        wroteBeyond |= ball >= launched;
        report.fail(where + "place " + text(k % rememberedPartners) +
                        (ball < count ? " of what ball " + text(ball) + " remembers"
                                      : " behind the end of what all remember"),
                    stored[k] == mark ? "untouched" : text(stored[k]),
                    expected[k] == mark ? "untouched" : text(expected[k]));
    }
    report.guess({{"it writes into the places of the next ball: only the first " +
                       text(rememberedPartners) + " partners are remembered",
                   [&] { return wroteBeyond; }},
                  {"a silent cap: more partners than are remembered were not counted", [&] {
                       Words capped = expectedCounts;
                       for (std::size_t k = 0; k < launched; ++k)
                           capped[k] = std::min(capped[k], rememberedPartners);
                       return got == capped && got != expectedCounts;
                   }}});
}

/// Ball 0 alone, then all: forwards, and backwards, where a ball that takes its neighbour's places
/// comes after it.
inline void counts(Report& report) {
    for (const LaunchOrder order : {LaunchOrder::forward, LaunchOrder::reversed}) {
        const Threads inForce(order, 1);
        for (const Scene06& scene : {fiveBalls, crowd(33)})
            for (const std::size_t launched : {std::size_t{1}, scene.balls.size()}) {
                requireCounts(report, scene, launched);
                if (report.failed()) return;
            }
    }
}

inline void reports(Report& report) {
    StepStatus status{};
    const std::uint32_t foundInRound[] = {5, 3, 9}, most[] = {5, 5, 9};
    for (std::uint32_t round = 0; round < 3; ++round) {
        reportPairs(foundInRound[round], status);
        const std::string after = " after rounds with 5, 3 and 9 pairs: round " + text(round + 1);
        const auto require = [&](const char* what, std::uint32_t got, std::uint32_t expected) {
            if (got != expected) report.fail(what + after, text(got), text(expected));
        };
        require("collisions", status.collisions, 5);
        require("pairsNeeded", status.pairsNeeded, most[round]);
        require("roundsDetected", status.roundsDetected, round + 1);
    }
    report.guess({{"only the last round is kept: a list too short for an earlier one stays so",
                   [&] { return status.collisions == 9; }},
                  {"rounds added up: the list is needed anew in each",
                   [&] { return status.pairsNeeded == 17 || status.collisions == 17; }}});
}

/// Runs the last part alone, with counts, places and memory as they must be, and a list whose last
/// places are not ours. Returns what the list then holds.
inline Pairs written(Device device, Ground& ground, std::uint32_t capacity) {
    const Pairs right = touchingPairs(ground.balls);
    const std::size_t count = ground.balls.size();
    Words counts(count, 0), starts(1, 0), remembered(count * rememberedPartners, 0);
    for (const Pair p : right) {
        const std::uint32_t k = counts[p.first]++;
        if (k < rememberedPartners) remembered[p.first * rememberedPartners + k] = p.second;
    }
    for (const std::uint32_t k : counts) starts.push_back(starts.back() + k);
    auto countsThere = uploaded(device, counts, "counts");
    auto startsThere = uploaded(device, starts, "starts");
    auto rememberedThere = uploaded(device, remembered, "remembered");
    auto status = uploaded(device, std::vector<StepStatus>{{}}, "status");
    DeviceBuffer<Pair> pairs(device, right.size() + 2, "pairs");
    pairs.fill(0xAB);
    PairsView list{pairs.view(), startsThere.view()};
    list.pairs.count = capacity;
    launch<writePairs>(device, static_cast<int>(count), ground.grid.view(),
                       ground.grid.sortedHashes(), ground.positions(),
                       View<const std::uint32_t>(countsThere.view()),
                       View<const std::uint32_t>(rememberedThere.view()), list, status.view());
    return pairs.download();
}

inline void writes(Report& report) {
    for (const Scene06& scene : {fiveBalls, crowd(12)}) {
        Ground ground(report.device, scene);
        const Pairs right = touchingPairs(ground.balls);
        for (const std::size_t capacity : {right.size() + 2, right.size() - 1, std::size_t{0}}) {
            const Pairs got = written(report.device, ground, static_cast<std::uint32_t>(capacity));
            Pairs expected(right.size() + 2, Pair{0xABABABABu, 0xABABABABu});
            std::copy_n(right.begin(), std::min(capacity, right.size()), expected.begin());
            bool wroteBeyond = false, shortened = false;
            for (std::size_t k = 0; k < got.size(); ++k) {
                if (got[k] == expected[k]) continue;
                const bool isOurs = k < std::min(capacity, right.size());
                (isOurs ? shortened : wroteBeyond) = true;
                report.fail(scene.name + ": place " + text(k) + " of a list of " + text(capacity),
                            got[k] == expected.back() ? "untouched" : text(got[k]),
                            isOurs ? text(expected[k]) : "untouched");
            }
            report.guess(
                {{"a write past the end: what lies behind the list belongs to someone else",
                  [&] { return wroteBeyond && !shortened; }},
                 {"the larger slot first",
                  [&] {
                      return got[0] == Pair{1, 0};
                  }},
                 {"only remembered partners are written: a ball with more must search again", [&] {
                      return shortened && ground.balls.size() == 12 && got[7] == right[7] &&
                             !(got[8] == right[8]);
                  }}});
        }
    }
}

inline void wholeList(Report& report) {
    Ground ground(report.device, fiveBalls);
    const Found got = found(report.device, ground);
    sameElements(report, got.starts, startsOfFive,
                 [](std::size_t k) { return "where the pairs of ball " + text(k) + " start"; });
    sameElements(report, got.stored, pairsOfFive,
                 [](std::size_t k) { return "entry " + text(k) + " of the list"; });
    if (got.rounds != 1) report.fail("reports of one search", text(got.rounds), "1");
    report.guess({{"no scan: places were never made from counts",
                   [&] { return got.starts.back() == 0xABABABABu; }},
                  {"filled before the scan: the places are those of the search before",
                   [&] { return got.starts == startsOfFive && got.needed != 5; }}});
}

}  // namespace ballpit::check
