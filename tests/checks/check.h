// The check library: what a chapter's checks are made of. See docs/authoring.md.
//
// A check is a function that gets a Report and tells it what is wrong. The runner calls it for
// every backend, catches what it throws, and writes the outcome as events.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/device.h"
#include "common/frame.h"
#include "common/pair_list.cuh"
#include "common/vec3.cuh"

namespace ballpit::check {

/// One wrong element.
struct Failure {
    std::string what, got, expected;
};

/// A known mistake, and whether the student's output is just what it would give.
struct Mistake {
    std::string name;
    std::function<bool()> matches;
};

class Report {
public:
    Report(Device device, std::uint64_t seed, std::string picturePath)
        : device(device), seed(seed), picturePath_(std::move(picturePath)) {}

    const Device device;
    const std::uint64_t seed;  ///< for random scenes

    /// One wrong element. All are counted, the first three are shown.
    void fail(std::string what, std::string got, std::string expected);

    /// A claim that has no elements: what is wrong, in one sentence.
    void fail(std::string message);

    /// Right in one thread order, different in `order`.
    void racy(std::string order);

    /// After a failure, the first mistake that explains the output becomes the guess.
    void guess(const std::vector<Mistake>& mistakes);

    /// An answer to the lesson's question ("Predict first"): shown with the verdict.
    void measured(std::string text) { measurements.push_back(std::move(text)); }

    /// Writes the picture if one was asked for; `draw` is only called then.
    void picture(const std::function<Frame()>& draw);

    bool failed() const { return failureCount > 0 || !message.empty() || isRacy; }

    std::vector<Failure> failures;
    std::size_t failureCount = 0;
    std::string message, looksLike;
    std::vector<std::string> measurements;
    std::string picturePath;  ///< of the picture that was written
    bool isRacy = false;

private:
    std::string picturePath_;
};

struct Check {
    std::string id;     ///< "hash.floor"
    std::string claim;  ///< true of every right solution
    std::string why;    ///< what breaks when it is not
    std::function<void(Report&)> body;
};

/// Runs the checks as the command line says, and returns the verdict's exit code. `takeHoles` gives
/// the ids of the open holes met since its last call.
int runChecks(int argc, char** argv, const std::string& chapter, const std::vector<Check>& checks,
              const std::function<std::vector<std::string>()>& takeHoles);

std::string text(bool value);
std::string text(int value);
std::string text(std::uint32_t value);
std::string text(std::size_t value);
std::string text(float value);
std::string text(Vec3 value);
std::string text(Int3 value);
std::string text(Pair value);

/// Compares element by element; `what(k)` names element k. True if all are equal. Lists of
/// different length fail as a whole.
template <class T, class What>
bool sameElements(Report& report, const std::vector<T>& got, const std::vector<T>& expected,
                  What what) {
    if (got.size() != expected.size()) {
        report.fail("number of elements", text(got.size()), text(expected.size()));
        return false;
    }
    for (std::size_t k = 0; k < got.size(); ++k)
        if (!(got[k] == expected[k])) report.fail(what(k), text(got[k]), text(expected[k]));
    return !report.failed();
}

/// Compares two sets of pairs, whatever their order: each expected pair once, and no other.
/// `describe` adds to a pair what a student needs to see (where the two balls are). True if equal.
bool samePairs(Report& report, const std::vector<Pair>& got, const std::vector<Pair>& expected,
               const std::function<std::string(Pair)>& describe);

}  // namespace ballpit::check
