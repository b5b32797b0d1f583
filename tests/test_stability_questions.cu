// What each charted scene asks: the meters on states made by hand.
#include <cmath>
#include <limits>

#include "stability/catalogue.h"
#include "stability/gas_truth.h"
#include "stability/meters.h"
#include "stability/metrics.h"
#include "stability/scenes.h"
#include "tests/support.h"
#include "truth/balls.h"

using namespace ballpit;
using namespace ballpit::stability;

namespace {

/// Two balls of 0.5 m and 1 kg at rest in a box without gravity, 2 m apart, but for what is given.
Scene twoBalls(Vec3 velocity) {
    Scene scene{"two", {}, {{-5, -5, -5}, {5, 5, 5}}, 2, {}, 0, 1.0f / 60};
    scene.spheres.add({-1, 0, 0}, velocity, 0.5f, 1, 1);
    scene.spheres.add({1, 0, 0}, {}, 0.5f, 1, 1);
    return scene;
}

Spheres withVelocities(const Scene& scene, Vec3 first, Vec3 second) {
    Spheres spheres = scene.spheres;
    spheres.velocities = {first, second};
    return spheres;
}

}  // namespace

TEST_CASE("every question is a scene of the catalogue, with its tolerance") {
    CHECK(questions().size() == 14);
    for (const Question& q : questions()) {
        CAPTURE(q.scene);
        const auto entry =
            std::find_if(catalogue().begin(), catalogue().end(),
                         [&](const Entry& e) { return e.name == std::string(q.scene); });
        REQUIRE(entry != catalogue().end());
        CHECK(q.tolerance == entry->within);
        CHECK(q.tolerance > 0);
        CHECK(q.make(1).name == q.scene);
        CHECK(&question(q.scene) == &q);
    }
    CHECK(question("666").scene == std::string("six_cubed"));
    CHECK(test::contains(test::messageOf<InputError>([] { question("pile"); }),
                         "scene 'pile': those with an error to chart are two_bodies, bounce"));
}

TEST_CASE(
    "a run that changes nothing is right at once where nothing should happen, and else wrong") {
    for (const Question& q : questions()) {
        CAPTURE(q.scene);
        const Scene scene = q.make(1);
        const auto meter = q.meter(scene, scene.dt);
        meter->add(scene.spheres, q.seconds);
        CHECK_FALSE(meter->hasFailed());
        const bool moves = std::string(q.error).find("E_true") != std::string::npos ||
                           std::string(q.error).find("angle") != std::string::npos ||
                           std::string(q.error).find("velocity") != std::string::npos ||
                           std::string(q.error).find("handed on") != std::string::npos;
        if (moves)
            CHECK(meter->error() > q.tolerance);
        else
            CHECK(meter->error() < 1e-3 * q.tolerance);
    }
}

TEST_CASE("the tolerance's text has its number") {
    for (const Entry& entry : catalogue()) CHECK_FALSE(test::contains(toleranceText(entry), "{}"));
    CHECK(toleranceText(catalogue()[0]) == "5 degrees, rms; momentum 1e-6");
}

TEST_CASE("an rms overlap is a share of the radius, and independent of the number of balls") {
    const std::vector<double> depths{0.3, 0.4};
    CHECK(rmsOverlap(depths, 2, 0.5) == Approx(std::sqrt(0.25 / 2) / 0.5));
    const std::vector<double> twice{0.3, 0.4, 0.3, 0.4};
    CHECK(rmsOverlap(twice, 4, 0.5) == Approx(rmsOverlap(depths, 2, 0.5)));
    CHECK(rmsOverlap({}, 0, 0) == 0);
}

TEST_CASE("a drift's root mean square counts gains and losses alike") {
    EnergyDrift drift(2);
    CHECK(drift.rms() == 0);
    drift.add(2.6), drift.add(1.2);
    CHECK(drift.rms() == Approx(std::sqrt((0.09 + 0.16) / 2)));
    CHECK(drift.mean() == Approx(-0.05));
}

TEST_CASE("a meter of energy gives the rms over the frames") {
    const Scene scene = twoBalls({2, 0, 0});
    EnergyMeter meter(scene, scene.dt);
    meter.add(scene.spheres, 1);
    CHECK(meter.error() == 0);
    meter.add(withVelocities(scene, {}, {std::sqrt(2.0f), 0, 0}), 2);  // half is gone
    CHECK(meter.error() == Approx(std::sqrt(0.25 / 2)));
    CHECK(meter.verdict() == Verdict::ok);
}

TEST_CASE("under gravity it is the shadow energy of the engine's own step that must stay") {
    Scene scene = twoBalls({});
    scene.gravity = {0, -10, 0};
    for (const float dt : {1.0f / 60, 1.0f / 30}) {
        CAPTURE(dt);
        EnergyMeter meter(scene, dt);
        Spheres now = scene.spheres;
        for (int step = 1; step <= 10; ++step)
            for (std::size_t k = 0; k < 2; ++k) {
                now.velocities[k] += dt * scene.gravity;
                now.positions[k] += dt * now.velocities[k];
                if (k == 1) meter.add(now, double(step) * dt);
            }
        CHECK(meter.error() < 1e-6);
    }
}

TEST_CASE("a meter of what is conserved tells the larger of the errors of energy and momentum") {
    const Scene scene = twoBalls({2, 0, 0});
    ConservationMeter meter(scene, scene.dt);
    meter.add(withVelocities(scene, {0, 0, 0}, {2, 0, 0}), 1);
    CHECK(meter.error() == Approx(0).margin(1e-9));
    meter.add(withVelocities(scene, {-2, 0, 0}, {}),
              2);  // the energy is right, and 4 of 2.83 kg m/s
    CHECK(meter.error() == Approx(4 / std::sqrt(8.0)));
    meter.add(withVelocities(scene, {1, 0, 0}, {1, 0, 0}), 3);  // the momentum is right
    CHECK(meter.error() == Approx(0.5));
}

TEST_CASE("a gas is held against the event-driven simulator at the same time") {
    // They meet after 0.5 s, with e = 0.5: 2 m/s becomes 0.5 and 1.5, energy 2 becomes 1.25.
    Scene scene = twoBalls({2, 0, 0});
    scene.spheres.restitutions = {0.5f, 0.5f};
    CHECK(trueEnergy(scene, 0.4) == Approx(2));
    CHECK(trueEnergy(scene, 0.6) == Approx(1.25));
    CoolingMeter meter(scene, scene.dt);
    meter.add(scene.spheres, 0.4);
    CHECK(meter.error() == Approx(0).margin(1e-9));
    meter.add(scene.spheres, 0.6);
    CHECK(meter.error() == Approx(2 / 1.25 - 1));
    meter.add(withVelocities(scene, {0.5f, 0, 0}, {1.5f, 0, 0}), 0.7);
    CHECK(meter.error() == Approx(0).margin(1e-9));
}

TEST_CASE("overlaps are averaged over time as squares") {
    const Scene scene = twoBalls({});
    OverlapMeter meter(scene, scene.dt);
    Spheres deep = scene.spheres;
    deep.positions[1].x = -0.25f;  // 0.25 m of 1
    meter.add(deep, 1), meter.add(scene.spheres, 2);
    CHECK(meter.error() == Approx(0.25 / std::sqrt(2.0) / 0.5 / std::sqrt(2.0)));
}

TEST_CASE("of a column at rest the last second counts, and falling through is a loss") {
    const Scene scene = makeColumn(2, 0);
    RestingMeter meter(scene, scene.dt, 3);
    Spheres now = scene.spheres;
    now.positions[1].y = 1.25f;  // half a radius too low
    meter.add(now, 1.9);
    CHECK(meter.error() == 0);
    meter.add(now, 2.1), meter.add(scene.spheres, 2.2);
    CHECK(meter.error() == Approx(0.5));
    now.positions[1].y = 0.4f;
    meter.add(now, 2.3);
    CHECK(meter.verdict() == Verdict::lost);
}

TEST_CASE("only the last ball of a cradle should fly off") {
    const Scene scene = makeCradle(2, false);
    CradleMeter meter(scene, scene.dt);
    meter.add(withVelocities(scene, {}, {1, 0, 0}), 1);
    CHECK(meter.error() == Approx(0).margin(1e-9));
    meter.add(withVelocities(scene, {0.25f, 0, 0}, {0.75f, 0, 0}), 1);
    CHECK(meter.error() == Approx(0.25));
}

TEST_CASE("pairs that pass unseen err by the whole angle") {
    const Scene scene = makeMeetings(4, 1);
    AngleMeter meter(scene, scene.dt);
    meter.add(scene.spheres, 1);
    double squares = 0;  // 2 acos(b), in degrees, with b^2 = 1/8, 3/8, ...
    for (const double share : {0.125, 0.375, 0.625, 0.875})
        squares += std::pow(2 * std::acos(std::sqrt(share)) * 180 / std::acos(-1), 2);
    CHECK(meter.error() == Approx(std::sqrt(squares / 4)).epsilon(1e-4));
}

TEST_CASE("a pair that turns as equal elastic balls do has no error of the angle") {
    const Scene scene = makeMeetings(4, 1);
    Spheres now = scene.spheres;
    for (std::size_t k = 0; k < 8; k += 2) {
        // The first hands on what it has along the line of centres at the contact.
        const float b = now.positions[k].y - now.positions[k + 1].y;  // m, of a diameter of 1 m
        const Vec3 line{std::sqrt(1 - b * b), -b, 0};
        const Vec3 given = dot(now.velocities[k], line) * line;
        now.velocities[k + 1] = given;
        now.velocities[k] = now.velocities[k] - given;
    }
    AngleMeter meter(scene, scene.dt);
    meter.add(now, 1);
    CHECK(meter.error() < 1e-3);
}

TEST_CASE("meetings start apart, each in a lane of its own") {
    const Scene scene = makeMeetings(128, 1);
    CHECK(overlapOf(scene.spheres, scene.bounds).contacts == 0);
    CHECK_FALSE(sameBits(scene.spheres, makeMeetings(128, 2).spheres));
    for (std::size_t k = 0; k < 256; k += 2)
        CHECK(std::abs(scene.spheres.positions[k].y - scene.spheres.positions[k + 1].y) < 1);
}

TEST_CASE("bullets that hand nothing on err by what they should have") {
    // Two lanes: 2 kg m/s are handed on in the first, 12 in the second.
    Scene scene = twoBalls({2, 0, 0});
    scene.spheres.add({-1, 4, 0}, {4, 0, 0}, 0.5f, 3, 1);
    scene.spheres.add({1, 4, 0}, {}, 0.5f, 3, 1);
    HandedOnMeter meter(scene, scene.dt);
    meter.add(scene.spheres, 1);
    CHECK(meter.error() == Approx(std::sqrt((4 + 144) / 2.0) / 7));
    Spheres now = scene.spheres;
    now.velocities = {{}, {2, 0, 0}, {}, {4, 0, 0}};
    meter.add(now, 1);
    CHECK(meter.error() == Approx(0).margin(1e-6));
}

TEST_CASE("a volley keeps its lanes apart as long as its question takes") {
    const Question& q = question("bullet");
    const Scene scene = q.make(1);
    CHECK(overlapOf(scene.spheres, scene.bounds).contacts == 0);
    const truth::Balls end = trueEnd(scene, q.seconds);
    const std::size_t inLane = scene.spheres.count() / 16;
    const auto& places = scene.spheres.positions;
    const float half = 0.5f * (places[inLane + 1].y - places[1].y);  // of a lane, m
    for (std::size_t k = 0; k < end.size(); ++k) {
        const Vec3 start = scene.spheres.positions[k / inLane * inLane];
        CHECK(std::abs(end[k].position.y - start.y) < half);
        CHECK(std::abs(end[k].position.z - start.z) < half);
        CHECK(end[k].position.x < scene.bounds.upper.x - 1);
    }
}

TEST_CASE("a meter says how a run has failed, once and for all") {
    const Scene scene = twoBalls({2, 0, 0});
    const auto verdictAfter = [&](const Spheres& now) {
        EnergyMeter meter(scene, scene.dt);
        meter.add(now, 1);
        meter.add(scene.spheres, 2);
        return meter.verdict();
    };
    CHECK(verdictAfter(scene.spheres) == Verdict::ok);
    CHECK(verdictAfter(withVelocities(scene, {2.4f, 0, 0}, {})) == Verdict::ok);
    CHECK(verdictAfter(withVelocities(scene, {2.5f, 0, 0}, {})) == Verdict::energy);
    Spheres outside = scene.spheres;
    outside.positions[0].z = 5.1f;
    CHECK(verdictAfter(outside) == Verdict::lost);
    outside.positions[0].z = std::numeric_limits<float>::infinity();
    CHECK(verdictAfter(outside) == Verdict::notFinite);
}
