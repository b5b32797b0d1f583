// The plan: for every charted scene it meets the tolerance, at no more than 1.5 times the work of
// the cheapest way that does; and each threshold is where it must be.
#include <numbers>

#include "stability/metrics.h"
#include "tests/plan_runs.h"
#include "tests/plan_scenes.h"

using namespace ballpit;
using stability::Question;

namespace {

test::Verdict runPlans(const Question& question, const PlanThresholds& thresholds = {},
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
          "[plan][long]") {
    const std::string scene = GENERATE(from_range(questionScenes()));
    const Question& question = stability::question(scene);
    const test::Verdict plan = runPlans(question);
    CAPTURE(scene, plan.worst, plan.work.visits, plan.work.moves);
    CHECK(plan.meets);
    for (const Way& way : allWays()) {
        const test::Verdict other =
            ran(question, way, [&](test::Work work) { return isMuchCheaper(work, plan.work); });
        CAPTURE(name(way.response), way.passes, way.substeps, way.stepsAFrame, other.worst,
                other.work.visits, other.work.moves);
        CHECK_FALSE((other.meets && isMuchCheaper(other.work, plan.work)));
    }
}

namespace {

using Threshold = double PlanThresholds::*;

/// A threshold made larger or smaller, and the scene that shows it.
struct Mutant {
    const char* what;
    Threshold threshold;
    double factor;
    const char* scene;
};

const std::vector<Mutant>& mutants() {
    using T = PlanThresholds;
    static const std::vector<Mutant> all{
        {"heapShare", &T::heapShare, 3, "mixed_radii"},
        {"heapShare", &T::heapShare, 1.0 / 3, "six_cubed"},
        {"columnShare", &T::columnShare, 1.0 / 3, "column"},
        {"narrowSquares", &T::narrowSquares, 1.0 / 3, "column"},
        {"warmShare", &T::warmShare, 3, "column"},
        {"layers", &T::layers, 3, "six_cubed_elastic"},
        {"bounceTravel", &T::bounceTravel, 3, "six_cubed_elastic"},
        {"bounceTravel", &T::bounceTravel, 1.0 / 3, "six_cubed_elastic"},
        {"coolingPerTravel", &T::coolingPerTravel, 3, "cooling_gas"},
        {"coolingPerTravel", &T::coolingPerTravel, 1.0 / 3, "cooling_gas"},
        {"missedPerTravel", &T::missedPerTravel, 3, "bullet"},
        {"missedPerTravel", &T::missedPerTravel, 1.0 / 3, "bullet"},
        {"thinShare", &T::thinShare, 3, "bullet"},
        {"anglePerTravel", &T::anglePerTravel, 3, "two_bodies"}};
    return all;
}

/// One run, and its error, of the two bodies with a tolerance other than the catalogue's.
double angleWith(double degrees, const PlanThresholds& thresholds) {
    const Question& question = stability::question("two_bodies");
    const test::Start start{&question, question.make(1), question.seconds};
    return test::runPlanned(start, degrees * std::numbers::pi / 180, thresholds).error;
}

/// The state after so many frames under the plan of the scene's start.
Spheres stateUnder(const Scene& scene, const Plan& plan, int frames) {
    return test::simulate(scene, planned(settingsFor(scene, Device::cpu), plan, worldOf(scene)),
                          frames * plan.stepsAFrame);
}

}  // namespace

TEST_CASE("a threshold that is three times off makes a charted scene miss, or much dearer",
          "[plan][long]") {
    const Mutant mutant = GENERATE(from_range(mutants()));
    PlanThresholds wrong;
    wrong.*mutant.threshold *= mutant.factor;
    const Question& question = stability::question(mutant.scene);
    const test::Verdict right = runPlans(question);
    const test::Verdict other = runPlans(question, wrong);
    CAPTURE(mutant.what, mutant.factor, mutant.scene, right.worst, other.worst, right.work.visits,
            other.work.visits, right.work.moves, other.work.moves);
    constexpr double much = 1.5;
    const bool dearer =
        other.work.visits > much * right.work.visits || other.work.moves > much * right.work.moves;
    CHECK((!other.meets || dearer));
}

TEST_CASE("few balls in much room: a tighter tolerance of the angle asks for smaller steps",
          "[plan]") {
    CHECK(angleWith(2.0, {}) <= 2.0);
    PlanThresholds wrong;
    wrong.anglePerTravel /= 3;
    CHECK(angleWith(2.0, wrong) > 2.0);
    wrong = {};
    wrong.thinShare /= 3;  // then the 256 balls count as a crowd, whose angles nobody asks for
    CHECK(angleWith(2.0, wrong) > 2.0);
}

TEST_CASE("elastic rain keeps its energy with the steps that its speed asks for", "[plan]") {
    const Question& question = stability::question("six_cubed_elastic");
    constexpr double tolerance = 0.04;
    PlanThresholds wrong;
    wrong.bouncePerTravel /= 3;
    for (const std::uint64_t seed : {1, 2}) {
        const test::Start start{&question, test::elasticRain(60, seed), 10};
        CAPTURE(seed);
        CHECK(test::runPlanned(start, tolerance).error <= tolerance);
        CHECK(test::runPlanned(start, tolerance, wrong).error > tolerance);
    }
    wrong = {};
    wrong.bouncePerTravel *= 3;
    CHECK(test::planOf(test::elasticRain(60, 1), tolerance, wrong).stepsAFrame >
          2 * test::planOf(test::elasticRain(60, 1), tolerance).stepsAFrame);
    // Below two layers balls may fly far in a step, above not.
    CHECK(test::planOf(test::elasticRain(60, 1), 0.1).stepsAFrame == 1);
    CHECK(test::planOf(test::elasticRain(160, 1), 0.1).stepsAFrame > 1);
    wrong = {};
    wrong.layers /= 3;
    CHECK(test::planOf(test::elasticRain(60, 1), 0.1, wrong).stepsAFrame > 1);
}

TEST_CASE("balls that overlap from the start are not thrown apart", "[plan]") {
    const auto energyGained = [](float overlap, const PlanThresholds& thresholds) {
        const Scene scene = test::pressedLattice(overlap);
        const Plan plan = test::planOf(scene, usualTolerance, thresholds);
        const auto energy = [&](const Spheres& s) {
            return measure(s, scene.bounds, scene.gravity, 0.0f).shadowEnergy;
        };
        const double unit = static_cast<double>(scene.spheres.count()) * 9.81 * 0.5;  // N m g r
        return (energy(stateUnder(scene, plan, 12)) - energy(scene.spheres)) / unit;
    };
    PlanThresholds wrong;
    wrong.safeOverlapSpeed *= 3;
    CHECK(energyGained(0.004f, {}) < 0.01);
    CHECK(energyGained(0.02f, {}) < 0.01);
    CHECK(energyGained(0.02f, wrong) > 0.05);
    // The neighbours of the threshold.
    CHECK(test::planOf(test::pressedLattice(0.004f)).response == ResponseMethod::smallSteps);
    CHECK(test::planOf(test::pressedLattice(0.02f)).response == ResponseMethod::warm);
}

TEST_CASE("a crowd without gravity comes apart as far as another choice could bring it",
          "[plan][long]") {
    const auto deepest = [](const Scene& scene, const PlanThresholds& thresholds) {
        const Spheres end = stateUnder(scene, test::planOf(scene, usualTolerance, thresholds), 20);
        return measure(end, scene.bounds, scene.gravity, scene.dt).largestPenetration;
    };
    PlanThresholds high, low;
    high.mostContacts *= 3;
    low.mostContacts /= 3;
    const Scene dense = test::looserCrowd(1.0f), loose = test::looserCrowd(1.6f);
    CHECK(deepest(dense, {}) < 0.95 * deepest(dense, high));
    CHECK(deepest(loose, {}) < 0.95 * deepest(loose, low));
    SceneFacts facts = factsOf(loose, Device::cpu);
    facts.mostContacts = 24;
    CHECK(makePlan(facts, worldOf(loose), 0.05).response == ResponseMethod::coloured);
    facts.mostContacts = 25;
    CHECK(makePlan(facts, worldOf(loose), 0.05).response == ResponseMethod::massSplit);
}
