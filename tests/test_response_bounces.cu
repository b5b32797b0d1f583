// Bounces on a floor and between balls, of every response, against the response's own scheme in
// double precision: what the discretisation makes of a restitution, and no more than that.
#include "tests/response_scenes.h"
#include "truth/motion.h"
#include "truth/penalty.h"

using namespace ballpit;

namespace {

constexpr double g = 9.81, radius = 0.5;

/// One ball above a floor at height 0: its lowest point, m, and its upward speed, m/s.
using truth::Fall;

/// What a step of h s does to the ball when all walls act at its end: chapter 07's integrate.
Fall putBack(Fall ball, double h, double e) {
    ball = truth::semiImplicitFall(ball, g, h, 1, 1);
    if (ball.height < 0) return {0, ball.speed < 0 ? -e * ball.speed : ball.speed};
    return ball;
}

/// The same where slow balls come to rest: the velocity is then the way that was left.
Fall putBackOrRested(Fall before, double h, double e) {
    const double threshold = 2 * g * h;
    const Fall free = truth::semiImplicitFall(before, g, h, 1, 1);
    if (free.height >= 0) return free;
    return {0, -free.speed > threshold ? -e * free.speed : 0};
}

/// The bounce takes the place of the whole step; a slow ball may come as near as to touch.
Fall turned(Fall before, double h, double e) {
    const double threshold = 2 * g * h;
    const Fall free = truth::semiImplicitFall(before, g, h, 1, 1);
    if (free.height >= 0) return free;
    const double speed = -free.speed > threshold ? -e * free.speed : -before.height / h;
    return {before.height + h * speed, speed};
}

/// A spring and a dashpot in the floor, of 20 steps a contact.
Fall sprung(Fall ball, double h, double e) {
    ball = truth::semiImplicitFall(ball, g, h, 1, 1);
    if (ball.height >= 0) return ball;
    const truth::ContactSpring press = truth::contactSpring(20 * h, e);
    return {ball.height,
            ball.speed - h * (press.spring * ball.height + press.dashpot * ball.speed)};
}

/// How a response moves a ball over a floor, and how often a step.
struct Scheme {
    Fall (*move)(Fall before, double h, double e);
    int substeps;
};
Scheme schemeOf(ResponseMethod method) {
    if (method == ResponseMethod::warm) return {turned, 1};
    if (method == ResponseMethod::smallSteps) return {putBackOrRested, 6};
    if (method == ResponseMethod::penalty) return {sprung, 16};
    return {putBack, 1};
}

/// Follows a ball from step to step: the highest place since it last rose.
class Climb {
public:
    /// True if the ball has just begun to fall.
    bool ends(Fall ball) {
        const bool rose = rises_;
        rises_ = ball.speed > 0;
        if (rises_ && !rose) highest_ = 0;
        highest_ = std::max(highest_, ball.height);
        return rose && !rises_;
    }
    double highest() const { return highest_; }

private:
    double highest_ = 0;
    bool rises_ = false;
};

constexpr float dt = 1.0f / 60.0f;

/// The height of the next bounce, m; 0 if the ball stays on the floor.
double nextPeak(Fall ball, const Scheme& scheme, double e) {
    Climb climb;
    for (int step = 0; step < 600; ++step) {
        for (int k = 0; k < scheme.substeps; ++k)
            ball = scheme.move(ball, double(dt) / scheme.substeps, e);
        if (climb.ends(ball)) return climb.highest();
    }
    return 0;
}

/// Thrown down from 5 m, so that no step ends exactly on the floor.
constexpr Fall start{5, -0.7};

Scene ballAtStart(float restitution) {
    Scene scene = test::emptyWorld();
    scene.bounds = {{-10, 0, -10}, {10, 40, 10}};
    scene.gravity = {0, -float(g), 0};
    scene.spheres.add({0.5f, float(start.height + radius), -0.5f}, {0, float(start.speed), 0},
                      float(radius), 2.0f, restitution);
    return scene;
}

}  // namespace

TEST_CASE("with each response a bounce reaches what its own scheme makes of e^2, within 1 %",
          "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    const ResponseMethod method = GENERATE(from_range(test::exactMethods()));
    const float restitution = GENERATE(0.0f, 0.3f, 0.5f, 0.8f, 0.95f, 1.0f);
    if (method == ResponseMethod::penalty && restitution == 0.0f) return;
    CAPTURE(device, method, restitution);
    const Scheme scheme = schemeOf(method);
    const Scene scene = ballAtStart(restitution);
    PhysicsSimulator simulator(test::settingsFor(scene, device, method));
    simulator.bodies().upload(scene.spheres);
    double expected = nextPeak(start, scheme, double(restitution));
    Climb climb;
    int bounces = 0;
    for (int step = 0; step < 600 && expected > 0.02; ++step) {
        simulator.step();
        const Spheres now = simulator.bodies().download();
        const Fall ball{now.positions[0].y - radius, double(now.velocities[0].y)};
        if (!climb.ends(ball)) continue;
        CAPTURE(++bounces);
        CHECK(climb.highest() == Approx(expected).epsilon(0.01));
        expected = nextPeak(ball, scheme, double(restitution));
    }
    CHECK(bounces >= (restitution < 0.1f ? 0 : restitution < 0.4f ? 1 : 3));
}

TEST_CASE("a scheme's own e^2 is the ideal one to about the way of a step at the floor",
          "[stability]") {
    const ResponseMethod method = GENERATE(from_range(test::exactMethods()));
    const double e = GENERATE(0.5, 0.8, 0.95, 1.0);
    CAPTURE(method, e);
    const double atFloor = std::sqrt(start.speed * start.speed + 2 * g * start.height);
    const double ideal = e * e * atFloor * atFloor / (2 * g);
    CHECK(std::abs(nextPeak(start, schemeOf(method), e) - ideal) < 1.25 * double(dt) * atFloor);
}
