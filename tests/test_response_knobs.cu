// What can be asked of the responses, and how what cannot be is refused.
#include "tests/response_scenes.h"

using namespace ballpit;

namespace {

/// What a simulator of `method` says to knobs changed by `change`.
template <class Change>
std::string refusal(ResponseMethod method, Change change) {
    SimulatorSettings settings;
    settings.objects = 2;
    settings.device = Device::cpu;
    settings.response = method;
    change(settings);
    return test::messageOf<InputError>([&] { PhysicsSimulator{settings}; });
}

using S = SimulatorSettings;

}  // namespace

TEST_CASE("a response's name leads back to it", "[stability]") {
    using enum ResponseMethod;
    for (const ResponseMethod method :
         {massSplit, racy, atomic, jacobi, coloured, warm, smallSteps, penalty}) {
        CHECK(responseMethod(name(method)) == method);
        CHECK(test::contains(responseNames(), name(method)));
    }
}

TEST_CASE("an unknown response is refused with the known ones", "[stability]") {
    const std::string message = test::messageOf<InputError>([] { responseMethod("gauss-seidel"); });
    CHECK(message ==
          "response 'gauss-seidel': known responses are mass-split, racy, atomic, "
          "jacobi, coloured, warm, small-steps, penalty");
}

TEST_CASE("a knob that a response does not have is refused, with those that have it",
          "[stability]") {
    using enum ResponseMethod;
    CHECK(refusal(massSplit, [](S& s) { s.substeps = 4; }) ==
          "substeps 4: the response mass-split has no such knob; those that have: small-steps, "
          "penalty");
    CHECK(refusal(coloured, [](S& s) { s.relaxation = 0.5f; }) ==
          "relaxation 0.5: the response coloured has no such knob; those that have: jacobi");
    CHECK(refusal(penalty, [](S& s) { s.iterations = 3; }) ==
          "iterations 3: the response penalty has no such knob; those that have: mass-split, racy, "
          "atomic, jacobi, coloured, warm, small-steps");
    CHECK(refusal(atomic, [](S& s) { s.restitutionThreshold = 1.0f; }) ==
          "restitution threshold 1: the response atomic has no such knob; those that have: jacobi, "
          "coloured, warm, small-steps");
    CHECK(refusal(smallSteps, [](S& s) { s.positionShare = 0.5f; }) ==
          "position share 0.5: the response small-steps has no such knob; those that have: jacobi, "
          "coloured, warm");
}

TEST_CASE("a knob out of its range is refused with the range", "[stability]") {
    using enum ResponseMethod;
    CHECK(refusal(warm, [](S& s) { s.iterations = 0; }) == "iterations 0: 1 to 1000 rounds a step");
    CHECK(refusal(smallSteps, [](S& s) { s.substeps = 0; }) == "substeps 0: 1 to 1000 a step");
    CHECK(refusal(penalty, [](S& s) { s.substeps = 1001; }) == "substeps 1001: 1 to 1000 a step");
    CHECK(refusal(jacobi, [](S& s) { s.relaxation = 0.0f; }) == "relaxation 0: 0.01 to 2");
    CHECK(refusal(jacobi, [](S& s) { s.relaxation = std::nanf(""); }) ==
          "relaxation nan: 0.01 to 2");
    CHECK(refusal(coloured, [](S& s) { s.restitutionThreshold = -1.0f; }) ==
          "restitution threshold -1: 0 to 1e+06 m/s");
    CHECK(refusal(warm, [](S& s) { s.positionShare = 1.5f; }) == "position share 1.5: 0.01 to 1");
}

TEST_CASE("springs refuse a restitution that no dashpot gives, and say who can", "[stability]") {
    Scene scene = test::emptyWorld();
    scene.spheres.add({0, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 0.5f);
    scene.spheres.add({2, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 0.0f);
    PhysicsSimulator simulator(test::settingsFor(scene, Device::cpu, ResponseMethod::penalty));
    simulator.bodies().upload(scene.spheres);
    const std::string message = test::messageOf<InputError>([&] { simulator.step(); });
    CHECK(test::contains(message, "restitution 0"));
    CHECK(test::contains(message, "needs at least 0.01"));
    CHECK(test::contains(message, "coloured or small-steps"));
    simulator.bodies().restitutions.upload({0.5f, 0.01f});
    simulator.step();
}

TEST_CASE("knobs left empty have the response's own values", "[stability]") {
    const ResponseKnobs plain = completed(ResponseMethod::massSplit, {}, 9.81f, 1.0f / 60.0f);
    CHECK(plain.iterations == 2);
    CHECK(plain.substeps == 1);
    CHECK(plain.restitutionThreshold == 0.0f);
    // What falls for two substeps is at rest.
    const ResponseKnobs small =
        completed(ResponseMethod::smallSteps, {.substeps = 10}, 9.81f, 1.0f / 60.0f);
    CHECK(small.iterations == 1);
    CHECK(small.substeps == 10);
    CHECK(*small.restitutionThreshold == Approx(2.0 * 9.81 / 600.0));
    CHECK(completed(ResponseMethod::smallSteps, {}, 0.0f, 1.0f).restitutionThreshold == 0.0f);
    CHECK(completed(ResponseMethod::warm, {.iterations = 3}, 9.81f, 0.01f).iterations == 3);
}

TEST_CASE("below its threshold nothing bounces, above it all does", "[stability]") {
    const ResponseMethod method = GENERATE(ResponseMethod::jacobi, ResponseMethod::coloured,
                                           ResponseMethod::warm, ResponseMethod::smallSteps);
    const float threshold = GENERATE(0.5f, 2.0f);
    CAPTURE(method, threshold);
    Scene scene = test::emptyWorld();
    scene.spheres.add({-0.505f, 0, 0}, {0.5f, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({0.505f, 0, 0}, {-0.5f, 0, 0}, 0.5f, 1.0f, 1.0f);
    SimulatorSettings settings = test::settingsFor(scene, Device::cpu, method);
    settings.restitutionThreshold = threshold;
    const Spheres end = test::simulate(scene, settings, 3);
    CHECK(end.velocities[1].x == Approx(threshold < 1.0f ? 0.5 : 0.0).margin(1e-5));
}

TEST_CASE("half the position share leaves half the overlap", "[stability]") {
    const ResponseMethod method = GENERATE(ResponseMethod::jacobi, ResponseMethod::coloured);
    Scene scene = test::emptyWorld();
    scene.spheres.add({-0.4f, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    scene.spheres.add({0.4f, 0, 0}, {0, 0, 0}, 0.5f, 1.0f, 1.0f);
    SimulatorSettings settings = test::settingsFor(scene, Device::cpu, method);
    settings.positionShare = 0.5f;
    settings.iterations = 1;
    const Spheres end = test::simulate(scene, settings, 1);
    CHECK(test::measureIn(scene, end).largestPenetration == Approx(0.1).epsilon(1e-5));
}
