// ballpit_plan: the plan for a scene, and why. `./ballpit plan` calls it.
#include <iostream>
#include <optional>

#include "12_speed_and_accuracy/plan_text.h"
#include "12_speed_and_accuracy/scene_facts.cuh"
#include "12_speed_and_accuracy/tolerance.h"
#include "common/cli.h"

using namespace ballpit;

namespace {

struct Asked {
    std::string scene = "gravity_fall";
    std::optional<int> count;
    std::optional<double> tolerance;
    std::uint64_t seed = 1;
    bool explain = false, json = false;
};

double toleranceOf(const Asked& asked) {
    const double tolerance = asked.tolerance.value_or(ballpit::toleranceOf(asked.scene));
    if (!(tolerance > 0)) throw InputError("--tolerance: must be above 0");
    return tolerance;
}

int run(const Asked& asked) {
    const double tolerance = toleranceOf(asked);
    const Scene scene =
        makeScene(asked.scene, asked.count.value_or(sceneKind(asked.scene).usualCount), asked.seed);
    const SceneFacts facts = factsOf(scene, Device::cpu);
    const World world = worldOf(scene);
    const Plan plan = makePlan(facts, world, tolerance);
    requireMet(plan);
    std::cout << (asked.json ? planJson(scene.name, facts, world, plan)
                             : planText(scene.name, facts, world, plan, asked.explain));
    return exitOk;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"The least model that answers a scene's question well enough, and why."};
    Asked asked;
    app.add_option("scene", asked.scene, sceneNames())->capture_default_str();
    app.add_option("--count", asked.count, "number of balls (default: the scene's own)");
    app.add_option("--tolerance", asked.tolerance,
                   "error that may be left, as a share of a radius or of the energy (default: the "
                   "scene's own, or 0.05)");
    app.add_option("--seed", asked.seed, "seed of the scene")->capture_default_str();
    app.add_flag("--explain", asked.explain, "tell the facts, and why each choice was made");
    app.add_flag("--json", asked.json, "print it as JSON");
    if (const auto end = endAfterParsing(app, argc, argv)) return *end;
    return reportingErrors([&] { return run(asked); });
}
