// The plan: for every charted scene it meets the tolerance, at no more than 1.5 times the work of
// the cheapest way that does; each threshold is where it must be; and a run that follows a plan is
// as exact as any.
#include "12_speed_and_accuracy/plan_text.h"
#include "common/error.h"
#include "tests/plan_runs.h"
#include "tests/with_threads.h"

using namespace ballpit;
using stability::Question;

namespace {

test::Verdict planned(const Question& question, const PlanThresholds& thresholds = {},
                      const test::StillOf& goesOn = test::always) {
    const double tolerance = toleranceOf(question.scene);
    return test::overAll(test::startsOf(question), question.tolerance, goesOn,
                         [&](const test::Start& start, const test::StillOf& still) {
                             return test::runPlanned(start, tolerance, thresholds, still);
                         });
}

/// One way of running a scene that the plan could have chosen.
struct Way {
    ResponseMethod response;
    int passes, substeps, stepsAFrame;
};

std::vector<Way> allWays() {
    using enum ResponseMethod;
    std::vector<Way> ways{{massSplit, 1, 1, 1}, {massSplit, 2, 1, 1}, {coloured, 2, 1, 1},
                          {jacobi, 2, 1, 1},    {warm, 1, 1, 1},      {warm, 2, 1, 1},
                          {warm, 4, 1, 1}};
    for (const int steps : {1, 2, 3, 4, 6, 8}) {
        ways.push_back({jacobi, 1, 1, steps});
        ways.push_back({coloured, 1, 1, steps});
        ways.push_back({smallSteps, 1, 1, steps});
        ways.push_back({smallSteps, 1, steps, 1});
    }
    return ways;
}

test::Verdict ran(const Question& question, const Way& way, const test::StillOf& goesOn) {
    return test::overAll(test::startsOf(question), question.tolerance, goesOn,
                         [&](const test::Start& start, const test::StillOf& still) {
                             SimulatorSettings s = settingsFor(start.scene, Device::cpu);
                             s.response = way.response;
                             s.iterations = way.passes;
                             if (way.response == ResponseMethod::smallSteps)
                                 s.substeps = way.substeps;
                             return test::runWith(start, s, way.stepsAFrame, still);
                         });
}

/// Is a piece of work much cheaper than the plan's: 1.5 times fewer visits; or, with as many
/// visits, 1.5 times fewer moves?
bool isMuchCheaper(test::Work work, test::Work plan) {
    constexpr double much = 1.5, asMany = 1.05;
    return work.visits < plan.visits / much ||
           (work.visits <= asMany * plan.visits && work.moves < plan.moves / much);
}

std::vector<std::string> questionScenes() {
    std::vector<std::string> names;
    for (const Question& question : stability::questions()) names.emplace_back(question.scene);
    return names;
}

}  // namespace

TEST_CASE("every charted scene's plan meets its tolerance, and nothing that does is much cheaper",
          "[plan]") {
    const std::string scene = GENERATE(from_range(questionScenes()));
    const Question& question = stability::question(scene);
    const test::Verdict plan = planned(question);
    CAPTURE(scene, plan.missed, plan.worst, plan.work.visits, plan.work.moves);
    CHECK(plan.meets());
    for (const Way& way : allWays()) {
        const test::Verdict other =
            ran(question, way, [&](test::Work work) { return isMuchCheaper(work, plan.work); });
        CAPTURE(name(way.response), way.passes, way.substeps, way.stepsAFrame, other.worst,
                other.work.visits, other.work.moves);
        CHECK_FALSE((other.meets() && isMuchCheaper(other.work, plan.work)));
    }
}
