// Sort, scan and reduce against the standard library, and the launch that all kernels go through.
#include <algorithm>
#include <numeric>

#include "03_sort/sort.cuh"
#include "common/random.h"
#include "common/with_threads.h"
#include "tests/support.h"

namespace ballpit::test {

/// Row phase + 1 from row `phase`: each number is its right neighbour's and 1. Only whoever has the
/// last column knows that there is more to do, until row `last` is there.
HD inline bool nextRow(int phase, int thread, int threads, int columns, int last,
                       View<std::uint32_t> rows) {
    bool more = false;
    for (int k = thread; k < columns; k += threads) {
        const int right = (k + 1) % columns;
        rows[(phase + 1) * columns + k] = rows[phase * columns + right] + 1;
        more = more || (k == columns - 1 && phase + 1 < last);
    }
    return more;
}

/// A kernel that counts its visits.
HD inline void countVisit(int i, View<std::uint32_t> visits) { fetchAdd(visits[i], 1); }

/// A kernel that notes the highest index ever given, to catch indices past the end.
HD inline void noteIndex(int i, int count, View<std::uint32_t> outOfRange) {
    if (i < 0 || i >= count) fetchAdd(outOfRange[0], 1);
}

}  // namespace ballpit::test

using namespace ballpit;

namespace {

using Numbers = std::vector<std::uint32_t>;

/// Around one, one block of threads, and one parallel loop or sort tile of the CPU; and many.
const std::vector<int> sizes{0, 1, 2, 255, 256, 257, 2047, 2048, 2049, 100000};

Numbers randomNumbers(int count, std::uint32_t below, std::uint64_t seed) {
    Random random(seed);
    Numbers numbers(static_cast<std::size_t>(count));
    for (std::uint32_t& number : numbers)
        number = static_cast<std::uint32_t>(random.next() % below);
    return numbers;
}

DeviceBuffer<std::uint32_t> onDevice(Device device, const Numbers& numbers) {
    DeviceBuffer<std::uint32_t> buffer(device, numbers.size(), "numbers");
    buffer.upload(numbers);
    return buffer;
}

struct Sorted {
    Numbers keys, values;
    bool operator==(const Sorted&) const = default;
};

/// The standard library's stable sort by the lowest `keyBits` bits; values are 0, 1, 2, ...
Sorted expectedOrder(const Numbers& keys, int keyBits) {
    const std::uint32_t mask = keyBits == 32 ? 0xFFFFFFFFu : (1u << keyBits) - 1u;
    Sorted sorted{{}, Numbers(keys.size())};
    std::iota(sorted.values.begin(), sorted.values.end(), 0u);
    std::stable_sort(sorted.values.begin(), sorted.values.end(),
                     [&](auto a, auto b) { return (keys[a] & mask) < (keys[b] & mask); });
    for (const std::uint32_t value : sorted.values) sorted.keys.push_back(keys[value]);
    return sorted;
}

Numbers firstNumbers(std::size_t count) {
    Numbers numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

Sorted sortWithLibrary(Device device, const Numbers& keys, int keyBits) {
    Scratch scratch(device, 0, "scratch");
    auto inKeys = onDevice(device, keys), inValues = onDevice(device, firstNumbers(keys.size()));
    auto outKeys = onDevice(device, keys), outValues = onDevice(device, keys);
    sortPairs(device, static_cast<int>(keys.size()), keyBits, inKeys.data(), inValues.data(),
              outKeys.data(), outValues.data(), scratch);
    return {outKeys.download(), outValues.download()};
}

Sorted sortWithChapter03(Device device, const Numbers& keys, int keyBits) {
    RadixSortSpace space(device, static_cast<int>(keys.size()));
    auto inKeys = onDevice(device, keys), inValues = onDevice(device, firstNumbers(keys.size()));
    radixSort(device, keyBits, inKeys, inValues, space);
    return {inKeys.download(), inValues.download()};
}

/// Compared as a whole, so that a failure does not print 100 000 numbers.
bool sameOrder(const Sorted& a, const Sorted& b) { return a == b; }

}  // namespace

TEST_CASE("sortPairs is the standard library's stable sort") {
    const Device device = GENERATE(from_range(test::devices()));
    const int threads = GENERATE(1, 2, 3);
    const int count = GENERATE(from_range(sizes));
    CAPTURE(threads, count);
    const WithThreads scope(threads);
    for (const int keyBits : {1, 2, 5, 8, 11, 12, 16, 22, 23, 31, 32}) {
        CAPTURE(keyBits);
        // Keys with higher bits set too: those must not count.
        const Numbers keys = randomNumbers(count, 0xFFFFFFFFu, 7);
        CHECK(sameOrder(sortWithLibrary(device, keys, keyBits), expectedOrder(keys, keyBits)));
    }
}

TEST_CASE("sortPairs sorts by every number of key bits from 1 to 32") {
    const Device device = GENERATE(from_range(test::devices()));
    const Numbers keys = randomNumbers(3000, 0xFFFFFFFFu, 8);
    for (int keyBits = 1; keyBits <= 32; ++keyBits) {
        CAPTURE(keyBits);
        CHECK(sameOrder(sortWithLibrary(device, keys, keyBits), expectedOrder(keys, keyBits)));
        CHECK(sameOrder(sortWithChapter03(device, keys, (keyBits + 3) / 4 * 4),
                        expectedOrder(keys, (keyBits + 3) / 4 * 4)));
    }
}

TEST_CASE("many equal keys keep their order in both sorts") {
    const Device device = GENERATE(from_range(test::devices()));
    const int count = GENERATE(from_range(sizes));
    const std::uint32_t different = GENERATE(1, 3, 100);
    CAPTURE(count, different);
    const Numbers keys = randomNumbers(count, different, 9);
    const Sorted expected = expectedOrder(keys, 32);
    CHECK(sameOrder(sortWithLibrary(device, keys, 7), expected));
    CHECK(sameOrder(sortWithChapter03(device, keys, 7), expected));
}

TEST_CASE("chapter 03's radix sort is the standard library's stable sort in every launch order") {
    const Device device = GENERATE(from_range(test::devices()));
    const LaunchOrder order =
        GENERATE(LaunchOrder::forward, LaunchOrder::reversed, LaunchOrder::shuffled);
    const int count = GENERATE(from_range(sizes));
    CAPTURE(static_cast<int>(order), count);
    const test::InOrder scope(order);
    const Numbers keys = randomNumbers(count, 1u << 22, 10);
    CHECK(sameOrder(sortWithChapter03(device, keys, 22), expectedOrder(keys, 22)));
}

TEST_CASE("exclusiveScan gives the sums before each element, and the total") {
    const Device device = GENERATE(from_range(test::devices()));
    const int threads = GENERATE(1, 2, 3);
    const int count = GENERATE(from_range(sizes));
    const std::uint32_t below = GENERATE(1, 2, 40000);  // below 1: all zero
    CAPTURE(threads, count, below);
    const WithThreads scope(threads);
    const Numbers counts = randomNumbers(count, below, 11);
    Numbers expected(counts.size() + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), expected.begin() + 1);

    Scratch scratch(device, 0, "scratch");
    auto input = onDevice(device, counts), starts = onDevice(device, Numbers(expected.size(), 77));
    exclusiveScan(device, count, input.data(), starts.data(), scratch);
    const bool same = starts.download() == expected;
    CHECK(starts.download().back() == expected.back());
    CHECK(same);
}

TEST_CASE("reduceMaximum is the largest element, wherever it is") {
    const Device device = GENERATE(from_range(test::devices()));
    const int threads = GENERATE(1, 2, 3);
    const int count = GENERATE(from_range(sizes));
    CAPTURE(threads, count);
    const WithThreads scope(threads);
    Scratch scratch(device, 0, "scratch");
    std::vector<float> values(static_cast<std::size_t>(count), -2.0f);
    for (const double place : {0.0, 0.5, 0.999999}) {
        const auto largest = static_cast<std::size_t>(place * count);
        CAPTURE(largest);
        if (count > 0) values[largest] = -1.0f;
        DeviceBuffer<float> buffer(device, values.size(), "values");
        buffer.upload(values);
        CHECK(reduceMaximum(device, count, buffer.data(), scratch) == (count ? -1.0f : 0.0f));
        if (count > 0) values[largest] = -2.0f;
    }
}

TEST_CASE("launch visits each index exactly once, in every order and on any number of threads") {
    const Device device = GENERATE(from_range(test::devices()));
    const LaunchOrder order =
        GENERATE(LaunchOrder::forward, LaunchOrder::reversed, LaunchOrder::shuffled);
    const int threads = GENERATE(1, 2, 3);
    const int count = GENERATE(0, 1, 2, 3, 4, 255, 256, 257, 4097);
    CAPTURE(static_cast<int>(order), threads, count);
    const WithThreads scope(threads);
    const test::InOrder orderScope(order);
    auto visits = onDevice(device, Numbers(static_cast<std::size_t>(count), 0));
    auto outOfRange = onDevice(device, {0});
    launch<test::countVisit>(device, count, visits.view());
    launch<test::noteIndex>(device, count, count, outOfRange.view());
    CHECK(visits.download() == Numbers(static_cast<std::size_t>(count), 1));
    CHECK(outOfRange.download()[0] == 0);
}

TEST_CASE(
    "phases follow each other, each on all of the one before, until no thread wants another") {
    const Device device = GENERATE(from_range(test::devices()));
    const int columns = GENERATE(1, 2, 511, 512, 513, 2000);
    constexpr int most = 20;
    const int last = GENERATE(1, 7, 20, 25);
    CAPTURE(columns, last);
    Numbers start(static_cast<std::size_t>(columns * (most + 1)), 0), expected = start;
    for (int k = 0; k < columns; ++k)
        start[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(7 * k);
    for (int phase = 0; phase <= std::min(last, most); ++phase)
        for (int k = 0; k < columns; ++k)
            expected[static_cast<std::size_t>(phase * columns + k)] =
                static_cast<std::uint32_t>(7 * ((k + phase) % columns) + phase);
    auto rows = onDevice(device, start);
    launchPhases<test::nextRow>(device, most, columns, last, rows.view());
    CHECK((rows.download() == expected));
}

TEST_CASE("the launch orders differ, so that a race would show") {
    std::vector<int> shuffled;
    for (int k = 0; k < 100; ++k) {
        CHECK(indexInOrder(LaunchOrder::forward, k, 100) == k);
        CHECK(indexInOrder(LaunchOrder::reversed, k, 100) == 99 - k);
        shuffled.push_back(indexInOrder(LaunchOrder::shuffled, k, 100));
    }
    CHECK_FALSE(std::is_sorted(shuffled.begin(), shuffled.end()));
    CHECK_FALSE(std::is_sorted(shuffled.rbegin(), shuffled.rend()));
}

TEST_CASE("a device buffer gives back what was uploaded") {
    const Device device = GENERATE(from_range(test::devices()));
    const int count = GENERATE(from_range(sizes));
    CAPTURE(count);
    const Numbers numbers = randomNumbers(count, 0xFFFFFFFFu, 12);
    DeviceBuffer<std::uint32_t> buffer = onDevice(device, numbers);
    const bool same = buffer.download() == numbers;
    CHECK(same);
    CHECK(buffer.count() == numbers.size());
    CHECK(buffer.bytes() == 4 * numbers.size());
    const DeviceBuffer<std::uint32_t> moved = std::move(buffer);
    CHECK(moved.download(numbers.size() / 2) ==
          Numbers(numbers.begin(), numbers.begin() + count / 2));
}

TEST_CASE("a device buffer refuses data of another size, naming itself and both sizes") {
    const Device device = GENERATE(from_range(test::devices()));
    DeviceBuffer<std::uint32_t> buffer(device, 3, "weights");
    CHECK_THROWS_WITH(buffer.upload(Numbers(2)), "upload of 2 elements, but weights has 3");
    CHECK_THROWS_WITH(buffer.upload(Numbers(4)), "upload of 4 elements, but weights has 3");
    CHECK_THROWS_WITH(buffer.download(4), "download of 4 elements, but weights has 3");
    buffer.resize(2);
    buffer.fill(0xFF);
    CHECK(buffer.download() == Numbers{0xFFFFFFFFu, 0xFFFFFFFFu});
}
