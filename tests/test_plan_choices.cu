// What the plan chooses on each side of a threshold, and how it says so: broad phase, cells,
// floats.
#include <algorithm>
#include <memory>

#include "12_speed_and_accuracy/plan_text.h"
#include "common/error.h"
#include "stability/scenes.h"
#include "tests/plan_runs.h"

using namespace ballpit;
using test::planOf;

namespace {

/// us, a step of one thread (two wait for each other where the machine is busy): the median of
/// several, taken in turn, so that whatever else the machine does hits all alike.
std::vector<double> stepTimes(const Scene& scene, const std::vector<SimulatorSettings>& ways) {
    const WithThreads one(1);
    std::vector<std::unique_ptr<PhysicsSimulator>> simulators;
    for (const SimulatorSettings& way : ways) {
        simulators.push_back(std::make_unique<PhysicsSimulator>(way));
        simulators.back()->bodies().upload(scene.spheres);
    }
    std::vector<std::vector<double>> times(ways.size());
    for (int round = 0; round < 41; ++round)
        for (std::size_t k = 0; k < ways.size(); ++k)
            times[k].push_back(1e3 * simulators[k]->step().frameTimeMs);
    std::vector<double> medians;
    for (std::vector<double>& of : times) {
        std::nth_element(of.begin(), of.begin() + 20, of.end());
        medians.push_back(of[20]);
    }
    return medians;
}

}  // namespace

TEST_CASE("the broad phase turns where comparing all with all gets slow", "[plan]") {
    const auto gas = [](int count) { return stability::makeGasOf({.count = count}); };
    CHECK(planOf(gas(200)).broadPhase == BroadPhaseMethod::naive);
    CHECK(planOf(gas(201)).broadPhase == BroadPhaseMethod::grid);
    PlanThresholds wrong;
    wrong.naiveMost *= 3;
    const Scene scene = gas(600);
    const SimulatorSettings base = settingsFor(scene, Device::cpu);
    const std::vector<double> us =
        stepTimes(scene, {planned(base, planOf(scene), worldOf(scene)),
                          planned(base, planOf(scene, usualTolerance, wrong), worldOf(scene))});
    CAPTURE(us[0], us[1]);
    CHECK(us[0] < us[1]);
}

TEST_CASE("cells are as small as balls, but no more than can be cleared in the time", "[plan]") {
    const Scene dense = stability::makeGasOf({.count = 2000});
    CHECK(planOf(dense).cellSize == 1.0f);
    const Scene sparse = stability::makeGasOf({.count = 2000, .volumeShare = 0.0005f});
    PlanThresholds wrong;
    wrong.cellsABall *= 30;
    const SimulatorSettings base = settingsFor(sparse, Device::cpu);
    const World world = worldOf(sparse);
    const std::vector<double> us =
        stepTimes(sparse, {planned(base, planOf(sparse), world),
                           planned(base, planOf(sparse, usualTolerance, wrong), world)});
    CAPTURE(us[0], us[1]);
    CHECK(us[0] < us[1]);
}

TEST_CASE("a periodic box is searched by its grid, however few the balls and large the cells",
          "[plan]") {
    const auto gas = [](float share) {
        return stability::makeGasOf({.count = 100, .volumeShare = share, .periodic = true});
    };
    Scene flat = test::emptyWorld(1.0f);
    flat.bounds = {{0, 0, 0}, {40, 4, 40}};  // so few balls ask for cells nearly as large as 4 m
    flat.periodic = true;
    for (const float x : {10.0f, 20.0f, 30.0f}) flat.spheres.add({x, 2, 2}, {1, 0, 0}, 0.5f, 1, 1);
    for (const Scene& box : {gas(0.3f), gas(0.001f), flat}) {
        CAPTURE(box.name, volumeShare(factsOf(box, Device::cpu), worldOf(box)));
        const SimulatorSettings settings =
            planned(settingsFor(box, Device::cpu), planOf(box), worldOf(box));
        CHECK(settings.broadPhase == BroadPhaseMethod::grid);
        CHECK_NOTHROW(PhysicsSimulator(settings));
    }
}

TEST_CASE("floats that are too coarse are warned of, and only those", "[plan]") {
    // At 4 floats a step: 16.3 km / 2 from the origin.
    CHECK(planOf(stability::makeFarFromOrigin(3, 5000)).warnings.empty());
    CHECK(planOf(stability::makeFarFromOrigin(3, 6500)).warnings.size() == 1);
    for (const char* scene : {"column", "deep_pile", "six_cubed", "gravity_fall", "elastic_gas"})
        CHECK(planOf(makeScene(scene, sceneKind(scene).usualCount, 1)).warnings.empty());
}

TEST_CASE("a tolerance that nothing meets is refused with the best there is and its cost",
          "[plan]") {
    const Scene scene = makeScene("six_cubed_elastic", 216, 1);
    const std::string message =
        test::messageOf<InputError>([&] { requireMet(planOf(scene, 1e-4)); });
    CHECK(test::contains(message, "tolerance 0.0001: the best within reach is 0.04"));
    CHECK(test::contains(message, "pair visits"));
    CHECK_NOTHROW(requireMet(planOf(scene, 0.1)));
}

TEST_CASE("a plan tells its reasons, and as JSON the same", "[plan]") {
    const Scene scene = makeScene("deep_pile", 1000, 1);
    const SceneFacts facts = factsOf(scene, Device::cpu);
    const World world = worldOf(scene);
    const Plan plan = makePlan(facts, world, 0.05);
    const std::string text = planText("deep_pile", facts, world, plan, true);
    for (const Choice& choice : plan.choices) {
        CHECK(test::contains(text, choice.what));
        CHECK_FALSE(choice.because.empty());
    }
    CHECK(test::contains(text, "left out"));
    CHECK_FALSE(test::contains(planText("deep_pile", facts, world, plan, false), "because"));
    CHECK(test::contains(planJson("deep_pile", facts, world, plan), "\"what\":\"substeps\""));
}
