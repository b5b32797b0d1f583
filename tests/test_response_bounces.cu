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

/// Follows a ball from step to step, and keeps the highest place of each bounce.
class Peaks {
public:
    void see(double height, double speed) {
        const bool risesNow = speed > 0;
        if (rising_ && !risesNow) heights.push_back(highest_);
        if (!rising_) highest_ = 0;
        highest_ = std::max(highest_, height);
        rising_ = risesNow;
    }
    std::vector<double> heights;

private:
    double highest_ = 0;
    bool rising_ = false;
};

constexpr double dropHeight = 5;
constexpr int steps = 600;
constexpr float dt = 1.0f / 60.0f;

std::vector<double> peaksOfScheme(const Scheme& scheme, double e) {
    Fall ball{dropHeight, 0};
    Peaks peaks;
    for (int step = 0; step < steps; ++step) {
        for (int k = 0; k < scheme.substeps; ++k)
            ball = scheme.move(ball, double(dt) / scheme.substeps, e);
        peaks.see(ball.height, ball.speed);
    }
    return peaks.heights;
}

std::vector<double> peaksUnder(ResponseMethod method, float restitution, Device device) {
    Scene scene = test::emptyWorld();
    scene.bounds = {{-10, 0, -10}, {10, 40, 10}};
    scene.gravity = {0, -float(g), 0};
    scene.spheres.add({0.5f, float(dropHeight + radius), -0.5f}, {0, 0, 0}, float(radius), 2.0f,
                      restitution);
    PhysicsSimulator simulator(test::settingsFor(scene, device, method));
    simulator.bodies().upload(scene.spheres);
    Peaks peaks;
    for (int step = 0; step < steps; ++step) {
        simulator.step();
        const Spheres now = simulator.bodies().download();
        peaks.see(now.positions[0].y - radius, now.velocities[0].y);
    }
    return peaks.heights;
}

}  // namespace

TEST_CASE("with each response bounces reach what its own scheme makes of e^2, within 1 %",
          "[stability]") {
    const Device device = GENERATE(from_range(test::devices()));
    const ResponseMethod method = GENERATE(from_range(test::exactMethods()));
    const float restitution = GENERATE(0.0f, 0.3f, 0.5f, 0.8f, 0.95f, 1.0f);
    if (method == ResponseMethod::penalty && restitution == 0.0f) return;
    CAPTURE(device, method, restitution);
    const std::vector<double> expected = peaksOfScheme(schemeOf(method), double(restitution));
    const std::vector<double> heights = peaksUnder(method, restitution, device);
    int compared = 0;
    for (std::size_t k = 0; k < expected.size() && expected[k] > 0.02; ++k, ++compared) {
        REQUIRE(heights.size() > k);
        CAPTURE(k);
        CHECK(heights[k] == Approx(expected[k]).epsilon(0.01));
    }
    CHECK((compared > 0) == (restitution > 0.0f));
}

TEST_CASE("the scheme's own e^2 is the ideal one less a few steps' fall", "[stability]") {
    const ResponseMethod method = GENERATE(from_range(test::exactMethods()));
    const double e = GENERATE(0.5, 0.8, 0.95, 1.0);
    CAPTURE(method, e);
    const double first = peaksOfScheme(schemeOf(method), e).front();
    const double ideal = truth::bounceHeight(dropHeight, 0, e, 1);
    CHECK(first == Approx(ideal).epsilon(method == ResponseMethod::penalty ? 0.05 : 0.09));
}
