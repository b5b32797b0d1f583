// Chapter 11's checks of steps: velocities from positions and their bounce, the sum of impulses
// that may not pull, the spring and its dashpot.
#pragma once

#include "10_full_system/physics_simulator.cuh"
#include "stability/scenes.h"
#include "tests/checks/check_11_colours.cuh"

namespace ballpit::check {

constexpr Bounds noWallsNear{{-1000, -1000, -1000}, {1000, 1000, 1000}};

// ---- small steps

/// A ball that moved freely to (1, 2, 3) with 4, 0 and -2 m/s and was pushed by 2 and -1 cm there,
/// in a substep of 10 ms.
inline void velocityByHand(Report& report) {
    Spheres ball;
    ball.add({1, 2, 3}, {4, 0, -2}, 0.5f, 2, 1);
    OneRound bodies(report.device, ball, {});
    DeviceBuffer<std::uint32_t> walls(report.device, 1, "walls");
    DeviceBuffer<Vec4> pushes(report.device, 0, "pushes");
    auto corrections = uploaded<Vec4>(report.device, {{0.02f, -0.01f, 0, 0.5f}}, "corrections");
    const SmallStepView view{bodies.round(), corrections.view(), walls.view(), pushes.view(), 1.0f};
    launch<velocityFromPositions>(report.device, 1, view, 0.01f);
    const Vec3 got = bodies.result().velocities[0];
    requireNear(report, "velocity after a push of (0.02, -0.01, 0) m in 10 ms", got, {6, -1, -2});
    requireNear(report, "place after it", bodies.result().positions[0], {1.02f, 1.99f, 3});
    const auto is = [&](Vec3 v) { return [got, v] { return length(got - v) < 1e-3f; }; };
    report.guess(
        {{"the push was not divided by the time it took", is({4.02f, -0.01f, -2})},
         {"divided by the step of a frame, 1/60 s, in place of the substep h",
          is({5.2f, -0.6f, -2})},
         {"only the push counts: the velocity with which the ball came is gone", is({2, -1, 0})},
         {"the push makes no velocity at all", is({4, 0, -2})}});
}

/// Two balls on the x axis that moved freely and overlap by 4 mm now, after one substep of 10 ms.
struct Head {
    float speedA, speedB, massB, restitution, threshold;
    Spheres after(Device device) const {
        Example pair{{}, {{0, 1}}};
        pair.balls.add({0, 0, 0}, {speedA, 0, 0}, 0.5f, 1, restitution);
        pair.balls.add({0.996f, 0, 0}, {speedB, 0, 0}, 0.5f, massB, restitution);
        SmallSteps response(device, 2, 1, {0.01f, 1, threshold, noWallsNear});
        return OneRound(device, pair.balls, pair.pairs).resolve(response);
    }
    std::string words() const {
        return brief(speedA) + " m/s meet " + brief(speedB) + " m/s, " + brief(massB) + " kg, e " +
               brief(restitution);
    }
};

inline void requireHead(Report& report, const Head& head, double a, double b) {
    const Spheres after = head.after(report.device);
    requireNear(report, head.words() + ": speed of the first", double(after.velocities[0].x), a);
    requireNear(report, head.words() + ": speed of the second", double(after.velocities[1].x), b);
}

inline void bounceHeadOn(Report& report) {
    // A default threshold of 1 m/s would eat this one.
    requireHead(report, {1, 0, 1, 1, 0.1f}, 0, 1);
    for (const float e : {0.0f, 0.3f, 0.5f, 0.8f, 1.0f})
        for (const float massB : {1.0f, 3.0f})
            for (const float speed : {1.0f, 0.2f}) {
                const Head head{speed, -0.5f * speed, massB, e, 0.1f};
                const auto [a, b] = truth::headOn(1, speed, massB, -0.5 * speed, e);
                requireHead(report, head, a, b);
            }
    const Spheres half = Head{1, 0, 1, 1, 0.1f}.after(report.device);
    // What mistakes make of 1 and -0.5 m/s, 1 kg, e = 0.5: the push alone parts them with 0.4 m/s.
    const Head known{1, -0.5f, 1, 0.5f, 0.1f};
    const Spheres got = known.after(report.device);
    const float parting = got.velocities[1].x - got.velocities[0].x;
    const auto parts = [parting](float speed) {
        return [parting, speed] { return std::abs(parting - speed) < 1e-3f; };
    };
    report.guess(
        {{"a restitution threshold of 1 m/s or more: who hits a ball at rest with 1 m/s stays with "
          "it, both at half the speed",
          [&] {
              return length(half.velocities[0] - Vec3{0.5f, 0, 0}) < 1e-3f;
          }},
         {"lively pairs got no impulse after their push was taken back", parts(-1.5f)},
         {"the push was not taken back: the bounce starts from the velocity after it, and not "
          "from the one before",
          parts(0.55f)},
         {"the push was given once more in place of being taken back", parts(0.35f)}});
}

inline void leavingPairs(Report& report) {
    for (const float threshold : {0.0f, 0.1f})
        for (const float e : {0.0f, 0.5f, 1.0f}) {
            requireHead(report, {-1, 2, 1, e, threshold}, -1, 2);
            requireHead(report, {0, 0.05f, 3, e, threshold}, 0, 0.05);
        }
    const Spheres got = Head{-1, 2, 1, 1, 0}.after(report.device);
    report.guess({{"balls that leave each other are turned back: an impulse needs an approach",
                   [&] { return got.velocities[1].x < 1.99f; }},
                  {"the speed of the push stays: the overlap throws them apart",
                   [&] { return got.velocities[1].x > 2.01f; }}});
}

inline void slowPairsRest(Report& report) {
    // Equal balls that meet with less than 0.1 m/s go on together.
    requireHead(report, {0.05f, 0, 1, 1, 0.1f}, 0.025, 0.025);
    requireHead(report, {0.05f, 0, 1, 1, 0.0f}, 0, 0.05);
    const Spheres got = Head{0.05f, 0, 1, 1, 0.1f}.after(report.device);
    report.guess({{"the speed of the push stays: the overlap throws them apart",
                   [&] { return got.velocities[1].x > 0.1f; }}});
}

/// The balls of a scene after so many steps of a method.
inline Spheres afterSteps(const Scene& scene, Device device, ResponseMethod method, int steps,
                          int passes = 0) {
    SimulatorSettings settings = settingsFor(scene, device);
    settings.response = method;
    if (passes) settings.iterations = passes;
    PhysicsSimulator simulator(settings);
    simulator.bodies().upload(scene.spheres);
    for (int k = 0; k < steps; ++k) simulator.step();
    return simulator.bodies().download();
}

inline double overlapInRadii(const Scene& scene, const Spheres& balls) {
    return measure(balls, scene.bounds, scene.gravity, scene.dt).largestPenetration /
           stability::ballRadius;
}

inline void restingBall(Report& report) {
    const Scene scene = stability::makeColumn(1, 0.5f);
    const Spheres after = afterSteps(scene, report.device, ResponseMethod::smallSteps, 120);
    requireNear(report, "height of a ball of 0.5 m on the floor after 2 s, m",
                double(after.positions[0].y), 0.5, 1e-3);
    requireNear(report, "its speed, m/s", double(length(after.velocities[0])), 0, 1e-3);
}

inline void columnOfTen(Report& report) {
    const Scene scene = stability::makeColumn(10, 0.0f);
    const double small =
        overlapInRadii(scene, afterSteps(scene, report.device, ResponseMethod::smallSteps, 180));
    if (!(small < 0.05))
        report.fail("ten balls on each other, 3 s: deepest overlap / r", text(float(small)),
                    "below 0.05");
}

/// A fast ball strikes a second one, which was at rest, and so had a short reach; within the same
/// step that one meets a third, which was not on its list.
inline void struckBeyondReach(Report& report) {
    Scene scene{"chain", {}, {{-20, -20, -20}, {20, 20, 20}}, 1.25f, {0, 0, 0}, 0, 1.0f / 60};
    for (const float x : {-1.02f, 0.0f, 1.25f})
        scene.spheres.add({x, 0, 0}, {x < -1 ? 30.0f : 0.0f, 0, 0}, 0.5f, 1, 1);
    const std::vector<Vec3> after =
        afterSteps(scene, report.device, ResponseMethod::smallSteps, 1).velocities;
    for (std::size_t k = 0; k < 3; ++k)
        requireNear(report, "three in a row, 30 m/s: speed of ball " + text(k) + " after a step",
                    double(after[k].x), k == 2 ? 30 : 0, 1e-3);
    report.guess(
        {{"the list of pairs was used beyond the reaches it was made for: the second "
          "ball passes into the third unseen",
          [&] { return std::abs(after[1].x - 30) < 1e-2f; }}});
}

// ---- accumulated impulses

/// One pass over one contact of balls of 1 kg and `massB`.
struct Pass {
    float sumBefore, wanted, separation, massB;
    double sumAfter;  ///< worked out by hand
};

inline float sumAfter(Device device, const Pass& pass) {
    Spheres balls;
    balls.add({0, 0, 0}, {0, 0, 0}, 0.5f, 1, 0);
    balls.add({1, 0, 0}, {pass.separation, 0, 0}, 0.5f, pass.massB, 0);
    OneRound bodies(device, balls, {{0, 1}});
    const ResponseRound round = bodies.round();
    launch<copyBody>(device, 2, round.from, round.to);
    auto sums = uploaded<float>(device, {pass.sumBefore}, "sums");
    auto wanted = uploaded<float>(device, {pass.wanted}, "wanted");
    WarmView view{};
    view.motion.round = round;
    view.impulses = sums.view();
    view.wanted = wanted.view();
    launch<accumulate>(device, 1, view);
    return sums.download()[0];
}

inline void sumsThatCannotPull(Report& report) {
    const std::vector<Pass> passes{
        {0, 0, -2, 1, 1},   {0, 0, -2, 3, 1.5}, {0, 1, -1, 1, 1},
        {0, 0, 1, 1, 0},    {3, 0, 1, 1, 2.5},  {0.25f, 0, 1, 1, 0},
        {3, 0, -1, 1, 3.5}, {0.5f, 0, 2, 3, 0}, {0, -0.5f, -0.25f, 1, 0}};
    std::vector<float> got;
    for (const Pass& p : passes) {
        got.push_back(sumAfter(report.device, p));
        requireNear(report,
                    "sum " + brief(p.sumBefore) + " N s, parting with " + brief(p.separation) +
                        " m/s, wanted " + brief(p.wanted) + ", " + brief(p.massB) +
                        " kg: sum after",
                    double(got.back()), p.sumAfter);
    }
    const auto all = [&](auto sum) {
        return [&passes, &got, sum] {
            for (std::size_t k = 0; k < passes.size(); ++k) {
                const Pass& p = passes[k];
                const float missing = (p.wanted - p.separation) / (1 + 1 / p.massB);
                if (std::abs(got[k] - sum(p.sumBefore, missing)) > 1e-5f) return false;
            }
            return true;
        };
    };
    report.guess({{"each change is kept from pulling, and not the sum: what was too much is never "
                   "taken back",
                   all([](float sum, float missing) { return sum + std::max(missing, 0.0f); })},
                  {"nothing is kept from pulling: contacts hold balls back that leave",
                   all([](float sum, float missing) { return sum + missing; })},
                  {"the sum of earlier passes is forgotten",
                   all([](float, float missing) { return std::max(missing, 0.0f); })}});
}

inline void columnOfTwenty(Report& report) {
    const Scene scene = stability::makeColumn(20, 0.0f);
    const double warm =
        overlapInRadii(scene, afterSteps(scene, report.device, ResponseMethod::warm, 180));
    if (!(warm < 0.1))
        report.fail("twenty balls on each other, 3 s: deepest overlap / r", text(float(warm)),
                    "below 0.1");
}

/// Not right, but what solving all contacts at once comes to.
inline void cradleAtOnce(Report& report) {
    const Scene scene = stability::makeCradle(5, false);
    const auto speedsAfter = [&](ResponseMethod method, int passes) {
        return afterSteps(scene, report.device, method, 60, passes).velocities;
    };
    const std::vector<double> once = truth::cradleAtOnce(5, 1), right = truth::cradleOneByOne(5);
    const std::vector<Vec3> warm = speedsAfter(ResponseMethod::warm, 200);
    const std::vector<Vec3> byPairs = speedsAfter(ResponseMethod::coloured, 2);
    for (std::size_t k = 0; k < 5; ++k) {
        requireNear(report, "all at once: speed of ball " + text(k), double(warm[k].x), once[k],
                    1e-3);
        requireNear(report, "pair by pair: speed of ball " + text(k), double(byPairs[k].x),
                    right[k], 1e-3);
    }
    const std::vector<Vec3> few = speedsAfter(ResponseMethod::warm, 1);
    char words[160];
    std::snprintf(words, sizeof words,
                  "Newton's cradle: the last of five leaves with %.3f m/s after 1 pass of warm, "
                  "with %.3f after 200",
                  double(few[4].x), double(warm[4].x));
    report.measured(words);
}

// ---- springs

inline void forceByHand(Report& report) {
    const PenaltySettings springs{0.001f, 0.02f, noWallsNear};
    struct Row {
        float depth, separation, restitution;
        double change;
    };
    // K = 9.8696 / 0.0004 = 24674 for e = 1; with ln 0.5 = -0.69315, K = 25875 and C = 69.315.
    const std::vector<Row> rows{{0.01f, 0, 1, 0.246740},    {0.01f, -1, 1, 0.246740},
                                {0.01f, 0, 0.5f, 0.258751}, {0.01f, -1, 0.5f, 0.328066},
                                {0.01f, 1, 0.5f, 0.189437}, {0, -1, 0.5f, 0.069315}};
    std::vector<float> got;
    for (const Row& r : rows) {
        got.push_back(pressure(r.depth, r.separation, r.restitution, springs));
        requireNear(report,
                    "depth " + brief(r.depth) + " m, parting with " + brief(r.separation) +
                        " m/s, e " + brief(r.restitution) + ": change of speed in 1 ms",
                    double(got.back()), r.change, 2e-5);
    }
    const auto all = [&](auto change) {
        return [&rows, &got, change] {
            for (std::size_t k = 0; k < rows.size(); ++k) {
                const Row& r = rows[k];
                const double l = std::log(double(r.restitution));
                const double spring = (9.8696044 + l * l) / 0.0004 * double(r.depth);
                if (std::abs(double(got[k]) - change(spring, -100 * l * double(r.separation))) >
                    1e-3 * std::abs(double(got[k])) + 1e-6)
                    return false;
            }
            return true;
        };
    };
    report.guess({{"a force, and not what it does in h: multiply by the substep",
                   all([](double spring, double dashpot) { return spring - dashpot; })},
                  {"a spring without its dashpot: every bounce is elastic",
                   all([](double spring, double) { return 0.001 * spring; })},
                  {"the dashpot drives: it must act against the speed",
                   all([](double spring, double dashpot) { return 0.001 * (spring + dashpot); })},
                  {"multiplied by a frame of 1/60 s in place of the substep",
                   all([](double spring, double dashpot) { return (spring - dashpot) / 60; })}});
}

/// A contact from touch to touch with 20 substeps.
inline void springsBounce(Report& report) {
    std::string found;
    for (const float e : {0.3f, 0.5f, 0.8f, 1.0f}) {
        const PenaltySettings springs{0.001f, substepsOfContact * 0.001f, noWallsNear};
        float depth = 0, separation = -1;
        for (int k = 0; k < 100 && depth >= 0; ++k) {
            depth -= springs.h * separation;
            if (depth > 0) separation += pressure(depth, separation, e, springs);
        }
        requireNear(report, "e " + brief(e) + ": speed after a contact met with 1 m/s",
                    double(separation), double(e), 0.03);
        char words[32];
        std::snprintf(words, sizeof words, "%s%.3f", found.empty() ? "" : ", ", double(separation));
        found += words;
    }
    report.measured("springs asked for e = 0.3, 0.5, 0.8, 1 give " + found);
}

/// A ball hits one at rest, along x and along other ways: the same speeds, and none across.
inline void springsEverywhere(Report& report) {
    bool rightAlongX = false;
    for (const Vec3 way :
         {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0.6f, 0, 0.8f}, Vec3{-0.48f, 0.6f, -0.64f}}) {
        Scene scene{"springs", {}, {{-20, -20, -20}, {20, 20, 20}}, 1.25f, {0, 0, 0}, 0, 1.0f / 60};
        scene.spheres.add({0, 0, 0}, way, 0.5f, 1, 0.5f);
        scene.spheres.add(1.01f * way, {0, 0, 0}, 0.5f, 1, 0.5f);
        const Vec3 got =
            afterSteps(scene, report.device, ResponseMethod::penalty, 10).velocities[1];
        const std::string where = "hit along " + brief(way) + ": the other ball's speed ";
        requireNear(report, where + "that way", double(dot(got, way)), 0.75, 0.02);
        requireNear(report, where + "across", double(length(got - dot(got, way) * way)), 0, 1e-3);
        if (way.x == 1) rightAlongX = !report.failed();
    }
    report.guess({{"the dashpot works on x, y and z by themselves, not along the normal",
                   [&] { return rightAlongX; }}});
}

}  // namespace ballpit::check
