// Checks of chapter 03: sorting pairs digit by digit. First each hole by hand, then what is true of
// every stable sort, then random lists.
#include "tests/checks/check_03_lists.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

/// As the lesson writes keys and digits.
std::string hex(std::uint32_t number) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "0x%x", number);
    return digits;
}

// ---- the checks

void digitByHand(Report& report) {
    struct Row {
        std::uint32_t key;
        int shift;
        std::uint32_t digit;
    };
    for (const Row& row :
         {Row{0x1A7, 0, 7}, Row{0x1A7, 4, 10}, Row{0x1A7, 8, 1}, Row{0x1A7, 12, 0},
          Row{0xF0000000u, 28, 15}, Row{0xF0000000u, 24, 0}, Row{0xFFFFFFFFu, 16, 15}}) {
        const std::uint32_t digit = digitOf(row.key, row.shift);
        if (digit != row.digit)
            report.fail("digit of key " + hex(row.key) + " at bit " + text(row.shift), hex(digit),
                        hex(row.digit));
    }
    report.guess({{"the mask is the number of bits; it must be four ones: 15",
                   [] { return digitOf(0x1A7, 0) == (7 & 4) && digitOf(0xFFFFFFFFu, 16) == 4; }}});
}

void layoutByHand(Report& report) {
    struct Row {
        std::uint32_t digit;
        int tile;
        std::uint32_t counter;
    };
    for (const Row& row : {Row{0, 0, 0}, Row{0, 1, 1}, Row{0, 2, 2}, Row{1, 0, 3}, Row{1, 2, 5},
                           Row{15, 0, 45}, Row{15, 2, 47}}) {
        const std::uint32_t counter = counterOf(row.digit, row.tile, 3);
        if (counter != row.counter)
            report.fail(
                "counter of digit " + text(row.digit) + " in tile " + text(row.tile) + " of 3",
                text(counter), text(row.counter));
    }
    report.guess(
        {{"the counters lie tile by tile; the scan would then put all of tile 0 before all "
          "of tile 1",
          [] { return counterOf(1, 0, 3) == 1 && counterOf(0, 1, 3) == digitCount; }}});
}

/// The first `count` keys, and 0xF up to the end of the last tile: those are not in the list.
Numbers paddedToTiles(Numbers keys) {
    keys.resize(static_cast<std::size_t>(tileCountFor(static_cast<int>(keys.size()))) * tileSize,
                0xFFFFFFFFu);
    return keys;
}

void countByHand(Report& report) {
    Numbers keys(100, 0x03);
    keys.resize(256, 0x2A);
    keys.insert(keys.end(), {0x37, 0x17, 0x02, 0x37, 0x0C});  // the second tile: five keys
    const int count = static_cast<int>(keys.size());
    Numbers low(2 * digitCount, 0), high = low;  // digit 0 of tiles 0 and 1, digit 1 of ...
    low[2 * 3 + 0] = 100, low[2 * 10 + 0] = 156;
    low[2 * 7 + 1] = 3, low[2 * 2 + 1] = 1, low[2 * 12 + 1] = 1;
    high[2 * 0 + 0] = 100, high[2 * 2 + 0] = 156;
    high[2 * 3 + 1] = 2, high[2 * 1 + 1] = 1, high[2 * 0 + 1] = 2;
    auto padded = uploaded(report.device, paddedToTiles(keys), "keys");
    bool lastTileFull = false;
    for (const int shift : {0, 4}) {
        auto counts = uploaded(report.device, Numbers(2 * digitCount, 77), "counts");
        launch<countDigits>(report.device, 2, count, shift,
                            View<const std::uint32_t>(padded.view()), counts.view());
        const Numbers got = counts.download();
        sameElements(report, got, shift ? high : low, [&](std::size_t k) {
            return "keys of tile " + text(k % 2) + " whose digit at bit " + text(shift) + " is " +
                   text(k / 2);
        });
        lastTileFull = lastTileFull || got[2 * 15 + 1] == 251;
    }
    report.guess({{"the last tile counted as a full one: it has only five keys, see tileEnd",
                   [&] { return lastTileFull; }}});
}

/// Where each tile's first pair of each digit goes, by counting from the start for each of them.
Numbers slowStarts(const Numbers& keys, int shift) {
    const std::size_t tileCount = (keys.size() + tileSize - 1) / tileSize;
    Numbers starts;
    for (std::uint32_t digit = 0; digit < digitCount; ++digit)
        for (std::size_t tile = 0; tile < tileCount; ++tile) {
            std::uint32_t before = 0;
            for (std::size_t i = 0; i < keys.size(); ++i) {
                const std::uint32_t other = keys[i] >> shift & 15u;
                before += other < digit || (other == digit && i / tileSize < tile);
            }
            starts.push_back(before);
        }
    return starts;
}

/// What one pass makes of `keys`, which do not fill their last tile.
void requireScatter(Report& report, const Numbers& keys, int shift, const Pairs& expected) {
    constexpr std::uint32_t nothing = 0xFFFFFFFFu;
    const int count = static_cast<int>(keys.size());
    const Numbers padded = paddedToTiles(keys), untouched(padded.size(), nothing);
    auto fromKeys = uploaded(report.device, padded, "fromKeys");
    auto fromValues = uploaded(report.device, upTo(padded.size()), "fromValues");
    auto toKeys = uploaded(report.device, untouched, "toKeys");
    auto toValues = uploaded(report.device, untouched, "toValues");
    auto starts = uploaded(report.device, slowStarts(keys, shift), "starts");
    const SortPassView pass{fromKeys.view(), fromValues.view(), toKeys.view(), toValues.view()};
    launch<scatterByDigit>(report.device, tileCountFor(count), count, shift, pass,
                           View<const std::uint32_t>(starts.view()));
    Pairs got{toKeys.download(), toValues.download()};
    const bool oneTooFar =
        std::equal(expected.keys.begin(), expected.keys.end(), got.keys.begin() + 1) &&
        std::equal(expected.values.begin(), expected.values.end(), got.values.begin() + 1);
    const auto at = [&](const char* what) {
        return [=](std::size_t k) {
            return what + text(k) + " after a pass over " + text(count) + " pairs";
        };
    };
    const std::uint32_t valueBehind = got.values[keys.size()];
    const bool beyond = valueBehind != nothing;
    if (beyond)
        report.fail("value at place " + text(count) + ", behind the last pair", text(valueBehind),
                    "nothing");
    got.keys.resize(keys.size()), got.values.resize(keys.size());
    sameElements(report, got.keys, expected.keys, at("key at place "));
    sameElements(report, got.values, expected.values, at("value at place "));
    report.guess(
        {{"every pair one place too far: the place is `next` as it was before it grows",
          [&] { return oneTooFar; }},
         {"the last tile moved as a full one: see tileEnd",
          [&] { return beyond && valueBehind >= keys.size(); }},
         {"the values do not move with their keys",
          [&] { return got.keys == expected.keys && got.values == upTo(keys.size()); }},
         {"a tile taken from its last pair to its first: pairs of one digit change their order",
          [&] {
              return got == backwardsPass({keys, upTo(keys.size())}, shift);
          }},
         {"all pairs of one digit land in one place: `next` must grow", [&] {
              for (std::size_t k = 0; k < keys.size(); ++k) {
                  const bool isFirst = k == 0 || (expected.keys[k] >> shift & 15u) !=
                                                     (expected.keys[k - 1] >> shift & 15u);
                  if (isFirst != (got.keys[k] != nothing)) return false;
              }
              return true;
          }}});
}

void scatterByHand(Report& report) {
    requireScatter(report, {0x53, 0x21, 0x43, 0x11, 0x33, 0x22, 0x41, 0x13}, 0,
                   {{0x21, 0x11, 0x41, 0x22, 0x53, 0x43, 0x33, 0x13}, {1, 3, 6, 5, 0, 2, 4, 7}});
    // By the higher digit, and with a second tile of two pairs.
    const Numbers keys = randomList(258, 8, report.seed).keys;
    requireScatter(report, keys, 4, inOrder(keys, 0xF0));
}

/// Keys with more digits than the sort is told of: a pass too many puts one of these in order, too.
void requireNoFurtherPass(Report& report) {
    for (const int keyBits : {digitBits, 2 * digitBits}) {
        const Numbers keys = randomList(300, 16, report.seed).keys;
        const Pairs got = sorted(report.device, {"", keyBits, keys});
        sameElements(report, got.keys, inOrder(keys, lowest(keyBits)).keys, [&](std::size_t k) {
            return "key at place " + text(k) + " after sorting 16-bit keys by their lowest " +
                   text(keyBits) + " bits";
        });
        const auto ordered = [&](int bits) {
            return [&, bits] { return got == inOrder(keys, lowest(bits)); };
        };
        report.guess({{"a pass for every bit: the next digit is digitBits further up",
                       ordered(keyBits + digitBits - 1)},
                      {"a pass too many: it sorts by a digit above the key's bits",
                       ordered(keyBits + digitBits)}});
    }
}

void passes(Report& report) {
    for (const int keyBits : {1, 4, 5, 8, 9, 20, 29, 32}) {
        const List list =
            randomList(40, keyBits, report.seed + static_cast<std::uint64_t>(keyBits));
        requireStableOrder(report, list, sorted(report.device, list));
    }
    requireNoFurtherPass(report);
    drawIfWrong(report);
    // The lesson's question.
    List list = randomList(1000, 8, report.seed);
    const Pairs expected = inOrder(list.keys);
    const auto atHome = [&](int keyBits) {
        list.keyBits = keyBits;
        const Numbers values = sorted(report.device, list).values;
        std::size_t count = 0;
        for (std::size_t k = 0; k < values.size(); ++k) count += values[k] == expected.values[k];
        return text(count);
    };
    report.measured("of 1000 pairs with keys of 8 bits, " + atHome(0) +
                    " are in their final place "
                    "before the first pass, " +
                    atHome(4) + " after it, " + atHome(8) + " after the second");
}

void ascending(Report& report) {
    for (const List& list : hardLists(report.seed)) {
        const Pairs got = sorted(report.device, list);
        for (std::size_t k = 1; k < got.keys.size(); ++k)
            if (got.keys[k - 1] > got.keys[k])
                report.fail("keys at places " + text(k - 1) + " and " + text(k) + ", " + list.name,
                            text(got.keys[k - 1]) + " before " + text(got.keys[k]),
                            "the smaller one first");
        guessMistake(report, list, got);
    }
    drawIfWrong(report);
}

void permutation(Report& report) {
    for (const List& list : hardLists(report.seed + 1)) {
        const Pairs got = sorted(report.device, list);
        std::vector<int> times(list.keys.size(), 0);
        for (std::size_t k = 0; k < got.values.size(); ++k) {
            const std::uint32_t value = got.values[k];
            if (value < times.size()) ++times[value];
            if (value >= times.size() || got.keys[k] != list.keys[value])
                report.fail("pair at place " + text(k) + ", " + list.name,
                            "key " + text(got.keys[k]) + " with value " + text(value),
                            value < times.size() ? "key " + text(list.keys[value]) +
                                                       " with this value, as before the sort"
                                                 : "a value below " + text(times.size()));
        }
        for (std::size_t value = 0; value < times.size(); ++value)
            if (times[value] != 1)
                report.fail("value " + text(value) + ", " + list.name,
                            text(times[value]) + " times", "once");
        guessMistake(report, list, got);
    }
    drawIfWrong(report);
}

void stable(Report& report) {
    // A single digit: one pass, in which each of 16 keys occurs often in each tile.
    std::vector<List> lists = hardLists(report.seed + 2);
    lists.insert(lists.begin(), randomList(700, 4, report.seed));
    for (const List& list : lists) {
        const Pairs got = sorted(report.device, list);
        for (std::size_t k = 1; k < got.keys.size(); ++k)
            if (got.keys[k - 1] == got.keys[k] && got.values[k - 1] >= got.values[k])
                report.fail("places " + text(k - 1) + " and " + text(k) + ", both with key " +
                                text(got.keys[k]) + ", " + list.name,
                            "value " + text(got.values[k - 1]) + " before " + text(got.values[k]),
                            "the smaller one first, as before the sort");
        guessMistake(report, list, got);
    }
    drawIfWrong(report);
}

void randomLists(Report& report) {
    std::uint64_t seed = report.seed + 3;
    for (const int count : {2, 33, 255, 256, 257, 1000, 3000})
        for (const int keyBits : {1, 5, 13, 20, 32}) {
            Sorter sorter(report.device, static_cast<std::size_t>(count));
            for (const char* which : {"", ", sorted in the arrays of the list before"}) {
                List list = randomList(count, keyBits, ++seed);
                list.name += which;
                requireStableOrder(report, list, sorter.sort(list));
            }
        }
    drawIfWrong(report);
}

void anyOrder(Report& report) {
    // So many that the CPU gives the tiles to several threads.
    const List list = randomList((serialCount + 52) * tileSize + 77, 8, report.seed + 4);
    inEveryOrder(report, [&] { return sorted(report.device, list); });
}

void library(Report& report) {
    // 5 x 5 x 5 cells: 7 bits. The bits above are set here to show that they are not looked at.
    const Bounds world{{0, 0, 0}, {5, 5, 5}};
    Scratch scratch(report.device, 0, "scratch");
    for (const int count : {0, 1, 2, 257, 1000}) {
        const List list = randomList(count, 9, report.seed + 5);
        UniformGrid grid(report.device, world, 1.0f, count);
        grid.hashes.upload(list.keys);
        grid.indices.upload(upTo(list.keys.size()));
        sortByHash(report.device, count, grid, scratch);
        const Pairs got{grid.sortedHashes.download(), grid.sortedIndices.download()};
        const Pairs expected = inOrder(list.keys, lowest(7));
        const auto at = [&](const char* what) {
            return [=](std::size_t k) { return what + text(k) + " of " + text(count); };
        };
        sameElements(report, got.keys, expected.keys, at("sorted hash "));
        sameElements(report, got.values, expected.values, at("sorted index "));
        report.guess({{"more bits compared than 125 cells need: see grid.hashBits()",
                       [&] { return got == inOrder(list.keys); }},
                      {"nothing written to the sorted arrays: sortPairs takes inputs, then outputs",
                       [&] { return count > 0 && got.keys == Numbers(got.keys.size(), ~0u); }}});
    }
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "03",
        {{"sort.digit", "The digit at bit s is what the bits s to s + 3 of the key say",
          "Each pass sorts by one digit. A bit in no digit is never looked at.", digitByHand},
         {"sort.layout", "The counters of one digit lie together, tile after tile",
          "The scan adds up in this order. So the pairs of digit 0 come first, and among them "
          "those "
          "of tile 0.",
          layoutByHand},
         {"sort.count", "The counters of a tile count its keys by digit, also in a short last tile",
          "Every key counted too much or too little moves all pairs behind it.", countByHand},
         {"sort.scatter", "A pass moves each pair to the next place of its digit, key and value",
          "The value says which ball it was. A key without its value is the hash of nobody.",
          scatterByHand},
         {"sort.passes", "There is one pass for each digit, also for a last one of fewer bits",
          "Chapter 05 needs equal hashes side by side; a bit that no pass looks at tears them "
          "apart. And each pass too many is a trip through memory for nothing.",
          passes},
         {"sort.sorted", "No key stands before a smaller one",
          "Chapter 05 finds where a cell starts by comparing neighbours in the list.", ascending},
         {"sort.permutation", "Every pair comes out once, its value beside its own key",
          "A ball whose number is lost is never drawn or hit again; a double is hit twice.",
          permutation},
         {"sort.stable", "Pairs with equal keys keep their order",
          "Each pass relies on it: it must not undo what the pass before it did. And the same "
          "balls give the same list on every machine.",
          stable},
         {"sort.random", "Random lists, two in the same arrays: as the standard library sorts them",
          "What no one thought of, and what an earlier sort left behind.", randomLists},
         {"sort.order", "The result does not depend on the order of the threads",
          "A GPU gives no order. A tile may read only what no other tile writes.", anyOrder},
         {"sort.library", "sortByHash sorts by as many bits as the cells need, and no more",
          "This is the sort of the engine. Each further digit is a further trip through memory.",
          library}});
}
