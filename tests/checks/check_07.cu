// Checks of chapter 07: random scenes, orders of the threads, and the list of all checks.
#include <set>

#include "10_full_system/physics_simulator.cuh"
#include "common/scene.h"
#include "tests/checks/canvas.h"
#include "tests/checks/check_07_response.cuh"

using namespace ballpit;
using namespace ballpit::check;

namespace {

// ---- random scenes

/// Velocities after the round: yours, the reference's, and where they differ both.
Frame drawVelocities(const Example& scene, const Spheres& got, const Spheres& expected) {
    return threePanels(-2.9f, -2.9f, 5.8f, 300, [&](Canvas& canvas, const Panel& panel, int k) {
        for (const Vec3 p : scene.balls.positions) {
            canvas.disc(panel.x(p.x), panel.y(p.y), panel.scale * 0.42f, colors::line);
            canvas.ring(panel.x(p.x), panel.y(p.y), panel.scale * 0.42f, 1.0f, colors::grey);
        }
        for (std::size_t b = 0; b < got.count(); ++b) {
            const Vec3 p = scene.balls.positions[b], v = got.velocities[b];
            const bool right = length(v - expected.velocities[b]) < 1e-3f;
            if (k == 0) arrow(canvas, panel, p, 0.9f * v, 0.22f, colors::ink);
            if (k == 1) arrow(canvas, panel, p, 0.9f * expected.velocities[b], 0.22f, colors::ink);
            if (k == 2 && !right) {
                arrow(canvas, panel, p, 0.9f * expected.velocities[b], 0.22f, {0.5f, 0.5f, 0.53f});
                arrow(canvas, panel, p, 0.9f * v, 0.22f, colors::red);
            }
        }
    });
}

std::vector<Mistake> mistakesOf(const Example& scene, const Spheres& got, bool split) {
    const auto with = [&](Rules rules) {
        return [&scene, &got, rules] { return haveVelocities(got, oracle(scene, rules)); };
    };
    return {{"no impulse arrives at all", with({.split = split, .share = 0})},
            {"the impulse has the wrong sign: it pulls the balls together",
             with({.split = split, .share = -1})},
            {"the impulse is applied twice", with({.split = split, .share = 2})},
            {"balls that leave each other get an impulse as well",
             with({.split = split, .pulls = true})},
            {"the mass of the first ball was used for both",
             with({.split = split, .massOfFirst = true})},
            {"the bouncier of the two balls decides; it is the duller one",
             with({.split = split, .bouncier = true})},
            {"masses are not split: a plain sum of impulses",
             [&, split] { return split && haveVelocities(got, oracle(scene, {.split = false})); }},
            {"the pairs read what other pairs write, in place of the bodies as they were", [&] {
                 return haveVelocities(got, resolvedBy(Version::inPlace, Device::cpu, scene));
             }}};
}

void requireOracle(Report& report, Version version, const Example& scene, const Spheres& got) {
    const bool split = version == Version::gathered;
    requireSameBalls(report, name(version), got, oracle(scene, {.split = split}), 2e-4f);
    report.guess(mistakesOf(scene, got, split));
}

void randomScenes(Report& report) {
    for (const Version version : mine) {
        const Example flat = flatScene(report.seed + 2);
        const Spheres got = resolvedBy(version, report.device, flat);
        requireOracle(report, version, flat, got);
        if (report.failed())
            return report.picture([&] {
                return drawVelocities(flat, got,
                                      oracle(flat, {.split = version == Version::gathered}));
            });
        for (const int count : {0, 1, 2, 33, 255, 256, 257, 1000}) {
            const Example scene = randomScene(count, report.seed + 3);
            requireOracle(report, version, scene, resolvedBy(version, report.device, scene));
        }
    }
}

void usedAgain(Report& report) {
    // One response, with buffers full of the round before, for different balls and contacts.
    ImpulseResponse response(report.device, 300, 2000);
    for (const std::uint64_t seed : {7, 8, 9}) {
        const Example scene = randomScene(300, report.seed + seed);
        const Spheres got = OneRound(report.device, scene.balls, scene.pairs).resolve(response);
        requireOracle(report, Version::gathered, scene, got);
    }
}

// ---- order

/// Rounds until the pulse has gone through the row, at most 9.
int roundsThrough(Version version, Device device, Example row) {
    const Vec3 pulse = row.balls.velocities.front() + row.balls.velocities.back();
    const std::size_t end = row.balls.velocities.front().x > 0 ? row.balls.count() - 1 : 0;
    int rounds = 0;
    while (rounds < 9 && length(row.balls.velocities[end] - pulse) > 1e-4f) {
        row.balls = resolvedBy(version, device, row);
        ++rounds;
    }
    return rounds;
}

void cradle(Report& report) {
    const Example forwards = rowOf({1, 0, 0, 0, 0}), backwards = rowOf({0, 0, 0, 0, -1});
    Example row = forwards, mirrored = backwards;
    for (std::size_t k = 1; k <= 4; ++k) {
        row.balls = resolvedBy(Version::gathered, report.device, row);
        mirrored.balls = resolvedBy(Version::gathered, report.device, mirrored);
        for (std::size_t ball = 0; ball < 5; ++ball) {
            const std::string what = "round " + text(k) + ": velocity of ball " + text(ball);
            requireNear(report, what + ", hit from ball 0", row.balls.velocities[ball],
                        {ball == k ? 1.0f : 0.0f, 0, 0});
            requireNear(report, what + ", hit from ball 4", mirrored.balls.velocities[ball],
                        {ball == 4 - k ? -1.0f : 0.0f, 0, 0});
        }
    }
    const auto rounds = [&](Version version) {
        return text(roundsThrough(version, report.device, forwards)) + " and " +
               text(roundsThrough(version, report.device, backwards));
    };
    report.measured("Newton's cradle of five, hit from ball 0 and from ball 4, takes " +
                    rounds(Version::inPlace) + " rounds in place, " + rounds(Version::gathered) +
                    " gathered");
}

/// How many different results five orders of the threads give.
std::size_t differentAnswers(Version version, Device device, const Example& scene) {
    std::set<std::uint64_t> hashes;
    for (const int threads : {1, 2})
        for (const LaunchOrder order :
             {LaunchOrder::forward, LaunchOrder::reversed, LaunchOrder::shuffled}) {
            const Threads inForce(order, threads);
            hashes.insert(stateHash(resolvedBy(version, device, scene)));
        }
    return hashes.size();
}

void anyOrder(Report& report) {
    const Example scene = randomScene(6000, report.seed + 5);
    inEveryOrder(report,
                 [&] { return stateHash(resolvedBy(Version::gathered, report.device, scene)); });
    std::string counts;
    for (const Version version : versions)
        counts += (counts.empty() ? "" : ", ") +
                  text(differentAnswers(version, report.device, scene)) + " " + name(version);
    report.measured("6000 balls in six orders of the threads, different answers: " + counts);
}

/// Balls that all lie in one place hit one ball, the second of each pair: every thread adds to it.
/// Each time half a metre a second is passed on, so the sum is exact in any order, if none is lost.
/// Each pair is listed 20 times, so that the threads work long enough to meet.
void nothingLost(Report& report) {
    constexpr std::uint32_t count = 100000, times = 20;
    Example crowd;
    for (std::uint32_t k = 0; k < count; ++k) {
        crowd.balls.add({0, -1, 0}, {0, 1, 0}, 0.5f, 1, 0);
        crowd.pairs.insert(crowd.pairs.end(), times, {k, count});
    }
    crowd.balls.add({0, 0, 0}, {0, 0, 0}, 0.5f, 1, 0);
    OneRound bodies(report.device, crowd.balls, crowd.pairs);
    AtomicResponse response(report.device);
    const auto requireAll = [&](int threads) {
        const Threads inForce(LaunchOrder::forward, threads);
        const Vec3 velocity = bodies.resolve(response).velocities[count];
        requireNear(report, "speed of a ball hit 2 million times, m/s, threads: " + text(threads),
                    velocity.y, 0.5 * count * times, 0);
    };
    requireAll(1);
    const bool isRightAlone = !report.failed();
    for (int k = 0; k < 4 && !report.failed(); ++k) requireAll(2 + k % 2);
    report.guess({{"a plain addition: between a thread's reading and its writing another one wrote",
                   [&] { return isRightAlone || report.device == Device::cuda; }}});
}

void pile(Report& report) {
    const Scene scene = makePile(500, report.seed);
    PhysicsSimulator simulator(settingsFor(scene, report.device));
    simulator.bodies().upload(scene.spheres);
    for (int k = 0; k < 60; ++k) simulator.step();
    const Metrics after =
        measure(simulator.bodies().download(), scene.bounds, scene.gravity, scene.dt);
    requireNear(report, "balls that are not finite", double(after.notFinite), 0);
    requireNear(report, "balls outside the walls", double(after.lost), 0);
    if (!(after.kineticEnergy > 0)) report.fail("the pile does not move at all");
    if (!(after.meanPenetration < 0.25))
        report.fail("mean overlap after 60 steps, m", text(float(after.meanPenetration)),
                    "below 0.25");
}

}  // namespace

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "07",
        {{"motion.step", "One step: velocity by gravity and damping, position by the new velocity",
          "The order of the three lines is the method: position before velocity is explicit Euler, "
          "which gains energy on every orbit and every bounce.",
          oneStep},
         {"motion.fall", "Free fall has a closed form: 120 steps give it",
          "An error of one g dt a step looks like nothing and is metres after two seconds.",
          freeFall},
         {"motion.walls", "A ball beyond a wall is put back; it bounces only if it moves outwards",
          "A push can leave a ball beyond a wall while it already comes back. Turned once more, it "
          "would stay there, trembling.",
          walls},
         {"impulse.line",
          "Two centres in one place have a line as well, and both balls agree on it",
          "0 / 0 is NaN. One NaN spreads to every ball it touches.", line},
         {"impulse.contact",
          "Normal of length 1 from first to second, overlap, speed of separation",
          "All that follows is measured along the normal.", contact},
         {"impulse.along_normal", "J = -(1 + e) v_n / (1/m_a + 1/m_b)",
          "It is the one impulse after which the balls leave with e times the speed they met with.",
          alongNormal},
         {"impulse.push", "The pushes of both balls add up to the overlap",
          "Impulses change velocities alone: the overlap would stay until the balls have left.",
          push},
         {"impulse.pair", "Impulse only while two balls approach, push as long as they overlap",
          "Balls overlap for several steps. An impulse in the second of them would undo the first.",
          pair},
         {"response.two_balls", "For one pair all three versions give the answer of a schoolbook",
          "Where nobody shares a ball there is no race, and nothing to split.", twoBallsMeet},
         {"response.split", "In each contact a ball takes part with 1/n of its mass",
          "So its contacts together move it no more than its mass allows.", splitMasses},
         {"response.pocket",
          "A plain sum gains energy by the formula of the lesson; split masses never gain",
          "A method that gains energy in one pocket blows up a pile of thousands.", pocket},
         {"response.conserved", "Momentum stays, and energy does not grow for e up to 1",
          "Whatever else is wrong, a push without its counterpart shows here.", conserved},
         {"response.random", "Random scenes: every ball as an oracle in double precision has it",
          "What no one thought of.", randomScenes},
         {"response.again", "A second round owes nothing to the first",
          "Lists and counts that are not emptied carry contacts into the next round.", usedAgain},
         {"response.cradle", "In Newton's cradle the pulse moves one ball a round, either way",
          "Gathered impulses do not know how the balls are numbered.", cradle},
         {"response.lost_updates", "Of two million impulses on one ball, none is lost",
          "Between a thread's reading and its writing, others write.", nothingLost},
         {"response.order", "Gathered: the same bits in every order of the threads",
          "Only then can a run be repeated, on any machine.", anyOrder},
         {"response.pile", "A pile of 500 balls stays finite and inside for 60 steps",
          "Your pieces inside the whole engine.", pile}});
}
