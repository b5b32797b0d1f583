// What chapter 03's checks sort: lists, the order they must come out in, the classic mistakes, and
// the picture. The oracle is the standard library's stable sort of whole keys: it knows nothing of
// digits, tiles or passes.
#pragma once

#include <algorithm>
#include <numeric>

#include "03_sort/sort.cuh"
#include "common/random.h"
#include "tests/checks/canvas.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

using Numbers = std::vector<std::uint32_t>;

/// Keys, and the number that travels with each: at first its place in the list.
struct Pairs {
    Numbers keys, values;
    bool operator==(const Pairs&) const = default;
};

/// A list to sort: no key has a bit above the lowest `keyBits`.
struct List {
    std::string name;
    int keyBits;
    Numbers keys;
};

inline std::uint32_t lowest(int bits) { return bits == 32 ? 0xFFFFFFFFu : (1u << bits) - 1u; }

inline Numbers upTo(std::size_t count) {
    Numbers numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

inline List randomList(int count, int keyBits, std::uint64_t seed) {
    Random random(seed);
    List list{text(count) + " random keys of " + text(keyBits) + " bits", keyBits, {}};
    for (int k = 0; k < count; ++k)
        list.keys.push_back(static_cast<std::uint32_t>(random.next()) & lowest(keyBits));
    return list;
}

/// One sort after the other in the same arrays, which keep what the sort before left in them.
class Sorter {
public:
    Sorter(Device device, std::size_t count)
        : device_(device),
          keys_(device, count, "keys"),
          values_(device, count, "values"),
          space_(device, static_cast<int>(count)) {}

    Pairs sort(const List& list) {
        keys_.upload(list.keys);
        values_.upload(upTo(list.keys.size()));
        radixSort(device_, list.keyBits, keys_, values_, space_);
        return {keys_.download(), values_.download()};
    }

private:
    Device device_;
    DeviceBuffer<std::uint32_t> keys_, values_;
    RadixSortSpace space_;
};

inline Pairs sorted(Device device, const List& list) {
    return Sorter(device, list.keys.size()).sort(list);
}

/// The pairs in stable order of key & mask.
inline Pairs inOrder(const Numbers& keys, std::uint32_t mask = 0xFFFFFFFFu) {
    Pairs pairs{{}, upTo(keys.size())};
    std::stable_sort(pairs.values.begin(), pairs.values.end(),
                     [&](auto a, auto b) { return (keys[a] & mask) < (keys[b] & mask); });
    for (const std::uint32_t value : pairs.values) pairs.keys.push_back(keys[value]);
    return pairs;
}

// The classic mistakes, for the guess.

/// Every tile sorted, and the tiles left where they are.
inline Pairs eachTileInOrder(const Numbers& keys) {
    Pairs pairs{{}, upTo(keys.size())};
    for (std::size_t begin = 0; begin < keys.size(); begin += tileSize)
        std::stable_sort(pairs.values.begin() + begin,
                         pairs.values.begin() + std::min(begin + tileSize, keys.size()),
                         [&](auto a, auto b) { return keys[a] < keys[b]; });
    for (const std::uint32_t value : pairs.values) pairs.keys.push_back(keys[value]);
    return pairs;
}

/// One pass over `shift` that takes every tile from its last pair to its first.
inline Pairs backwardsPass(const Pairs& from, int shift) {
    Numbers order = upTo(from.keys.size());
    for (std::size_t begin = 0; begin < order.size(); begin += tileSize)
        std::reverse(order.begin() + begin,
                     order.begin() + std::min(begin + tileSize, order.size()));
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
        return (from.keys[a] >> shift & 15u) < (from.keys[b] >> shift & 15u);
    });
    Pairs to;
    for (const std::uint32_t k : order) {
        to.keys.push_back(from.keys[k]);
        to.values.push_back(from.values[k]);
    }
    return to;
}

inline Pairs backwards(const List& list) {
    Pairs pairs{list.keys, upTo(list.keys.size())};
    for (int shift = 0; shift < list.keyBits; shift += digitBits)
        pairs = backwardsPass(pairs, shift);
    return pairs;
}

inline bool valuesLeftBehind(const List& list, const Pairs& got) {
    for (std::size_t k = 0; k < got.values.size(); ++k)
        if (got.values[k] < list.keys.size() && list.keys[got.values[k]] != got.keys[k])
            return got.keys == inOrder(list.keys).keys;
    return false;
}

/// Only for lists long enough to tell one mistake from another. (With a single pass, a pass that is
/// missing and arrays that are not swapped look alike.)
inline void guessMistake(Report& report, const List& list, const Pairs& got) {
    if (list.keys.size() < 33 || got == inOrder(list.keys)) return;
    const bool severalPasses = list.keyBits > digitBits;
    const int lastShift = (list.keyBits - 1) / digitBits * digitBits;
    report.guess(
        {{"the keys stay where they were: the passes wrote to the other arrays, and the arrays "
          "were not swapped",
          [&] { return severalPasses && got.keys == list.keys; }},
         {"the last pass is missing: a digit of fewer than four bits is a digit, too",
          [&] { return severalPasses && got == inOrder(list.keys, lowest(lastShift)); }},
         {"every tile is sorted by itself: the counters lie tile by tile, not digit by digit",
          [&] { return got == eachTileInOrder(list.keys); }},
         {"a tile taken from its last pair to its first: equal digits change their order",
          [&] { return got == backwards(list); }},
         {"the values do not move with their keys", [&] { return valuesLeftBehind(list, got); }}});
}

/// A staircase of 12 steps, mixed, in one full tile and one short one.
inline List staircase() {
    List list{"300 keys with 12 different values", 5, {}};
    for (std::uint32_t k = 0; k < 300; ++k) list.keys.push_back(k * 7u % 12u * 2u + 9u);
    return list;
}

/// Bars from left to right in list order. Height: the key. Colour: the value, which is the pair's
/// place in the unsorted list, from yellow (first) to violet (last).
inline Frame drawList(const List& list, const Pairs& got) {
    const Pairs expected = inOrder(list.keys);
    const int count = static_cast<int>(list.keys.size());
    const float side = static_cast<float>(count), tallest = 33.0f;
    const Vec3 first{0.99f, 0.82f, 0.25f}, last{0.30f, 0.08f, 0.45f};
    const auto drawBars = [&](Canvas& canvas, const Panel& panel, int k) {
        const Pairs& shown = k == 0 ? got : expected;
        for (int i = 0; i < count; ++i) {
            const bool wrong =
                got.keys[i] != expected.keys[i] || got.values[i] != expected.values[i];
            const float age = std::min(static_cast<float>(shown.values[i]) / side, 1.0f);
            const Vec3 color = k < 2   ? first + age * (last - first)
                               : wrong ? colors::red
                                       : colors::grey;
            const float height = static_cast<float>(std::min(shown.keys[i], 31u) + 1) / tallest;
            const float x = panel.x(static_cast<float>(i));
            canvas.rectangle(x, panel.y(side * height), x + panel.scale, panel.y(0), color);
        }
    };
    return threePanels(0, 0, side, count, drawBars);
}

inline void drawIfWrong(Report& report) {
    if (!report.failed()) return;
    report.picture([&] { return drawList(staircase(), sorted(report.device, staircase())); });
}

/// The claim that most checks share: the one stable order, keys and values.
inline void requireStableOrder(Report& report, const List& list, const Pairs& got) {
    const Pairs expected = inOrder(list.keys);
    const auto keyAt = [&](std::size_t k) { return "key at place " + text(k) + ", " + list.name; };
    const auto valueAt = [&](std::size_t k) {
        return "value at place " + text(k) + " beside key " + text(expected.keys[k]) + ", " +
               list.name;
    };
    if (sameElements(report, got.keys, expected.keys, keyAt))
        sameElements(report, got.values, expected.values, valueAt);
    guessMistake(report, list, got);
}

/// The lists on which a sort usually fails.
inline std::vector<List> hardLists(std::uint64_t seed) {
    std::vector<List> lists;
    for (const int count : {0, 1, 2, 33, 255, 256, 257, 1000})
        lists.push_back(randomList(count, 8, seed + static_cast<std::uint64_t>(count)));
    Numbers ascending = upTo(600);
    lists.push_back({"600 keys sorted already", 10, ascending});
    std::reverse(ascending.begin(), ascending.end());
    lists.push_back({"600 keys in reverse order", 10, ascending});
    lists.push_back({"600 times the key 37", 6, Numbers(600, 37u)});
    lists.push_back(staircase());
    return lists;
}

}  // namespace ballpit::check
