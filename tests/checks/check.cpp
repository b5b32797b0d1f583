// Reports, and how values and pairs are compared and shown.
#include "tests/checks/check.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "common/error.h"

namespace ballpit::check {

namespace {

constexpr std::size_t failuresShown = 3;

}  // namespace

void Report::fail(std::string what, std::string got, std::string expected) {
    ++failureCount;
    if (failures.size() < failuresShown)
        failures.push_back({std::move(what), std::move(got), std::move(expected)});
}

void Report::fail(std::string what) {
    if (message.empty()) message = std::move(what);
}

void Report::racy(std::string order) {
    isRacy = true;
    fail("the result changes with the order of the threads: " + std::move(order));
}

void Report::guess(const std::vector<Mistake>& mistakes) {
    if (!failed() || !looksLike.empty()) return;
    for (const Mistake& mistake : mistakes) {
        if (!mistake.matches()) continue;
        looksLike = mistake.name;
        return;
    }
}

void Report::picture(const std::function<Frame()>& draw) {
    if (picturePath_.empty() || !picturePath.empty()) return;
    writePng(picturePath_, draw());
    picturePath = picturePath_;
}

std::string text(bool value) { return value ? "true" : "false"; }
std::string text(int value) { return std::to_string(value); }
std::string text(std::uint32_t value) { return std::to_string(value); }
std::string text(std::size_t value) { return std::to_string(value); }
std::string text(float value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.9g", static_cast<double>(value));
    return digits;
}
std::string text(Vec3 v) { return "(" + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + ")"; }
std::string text(Int3 v) { return "(" + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + ")"; }
std::string text(Pair p) { return "(" + text(p.first) + ", " + text(p.second) + ")"; }

bool samePairs(Report& report, const std::vector<Pair>& got, const std::vector<Pair>& expected,
               const std::function<std::string(Pair)>& describe) {
    std::map<Pair, std::pair<int, int>> times;  // pair: times got, times expected
    for (const Pair pair : got) ++times[pair].first;
    for (const Pair pair : expected) ++times[pair].second;
    const auto inWords = [](int count) {
        return count == 0 ? std::string("not listed") : "listed " + std::to_string(count) + "x";
    };
    for (const auto& [pair, count] : times) {
        if (count.first == count.second) continue;
        report.fail("pair " + text(pair) + describe(pair), inWords(count.first),
                    inWords(count.second));
    }
    return !report.failed();
}

}  // namespace ballpit::check
