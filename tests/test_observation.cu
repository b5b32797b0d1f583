// What can be seen of a simulation between two steps.
#include "10_full_system/observation.cuh"
#include "tests/support.h"

using namespace ballpit;

namespace {

/// What colours tell of contacts after a step; `listed`: the pairs that the step listed.
std::vector<Vec3> contactColorsAfterStep(const Scene& scene, const SimulatorSettings& settings,
                                         std::size_t& listed) {
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    Observation now(simulator, scene);
    now.stepDone(simulator.step());
    listed = simulator.lastPairs().size();
    return now.colors(ColorBy::contacts);
}

}  // namespace

TEST_CASE("with substeps near pairs are listed, but only those that touch are seen as contacts") {
    const Device device = GENERATE(from_range(test::devices()));
    const ResponseMethod method = GENERATE(ResponseMethod::warm, ResponseMethod::smallSteps);
    CAPTURE(device, name(method));
    // In one lane two balls touch; in another they stay 0.05 r apart, within reach of each other.
    Scene scene = test::emptyWorld();
    scene.spheres.add({-0.4999f, 5, 0}, {}, 0.5f, 1, 1);
    scene.spheres.add({0.4999f, 5, 0}, {}, 0.5f, 1, 1);
    scene.spheres.add({-0.5125f, 0, 0}, {}, 0.5f, 1, 1);
    scene.spheres.add({0.5125f, 0, 0}, {}, 0.5f, 1, 1);
    SimulatorSettings settings = settingsFor(scene, device);
    settings.response = method;
    std::size_t listed = 0;
    const std::vector<Vec3> colors = contactColorsAfterStep(scene, settings, listed);
    REQUIRE(listed == 2);
    CHECK(colors[0] == contactColor(1));
    CHECK(colors[1] == contactColor(1));
    CHECK(colors[2] == contactColor(0));
    CHECK(colors[3] == contactColor(0));
}
