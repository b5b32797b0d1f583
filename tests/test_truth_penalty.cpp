// The closed forms of a penalty contact against the integration of its motion.
#include "tests/truth_support.h"
#include "truth/penalty.h"

using namespace ballpit::truth;

namespace {

struct Bounce {
    double duration, deepest, speedAfter;
};

/// A spring and a dashpot, hit with the speed v, until it is as long as at the start; a linear one,
/// as in the closed forms, which may pull at the end. The contact is found `late`, this share of a
/// step after it began.
Bounce integrated(double v, double k, double m, double damping, double dt, double late = 0) {
    double overlap = late * dt * v, speed = v, time = late * dt, deepest = 0;
    const double omega = std::sqrt(k / m);
    do {
        speed -= dt * (omega * omega * overlap + 2 * damping * omega * speed);
        overlap += dt * speed;
        time += dt;
        deepest = std::max(deepest, overlap);
    } while (overlap > 0);
    return {time, deepest, -speed};
}

/// The restitutions that steps of `perContact` to a contact time come to, over all phases.
struct Spread {
    double lowest = 9, mean = 0, highest = 0;
};
Spread restitutions(double e, double perContact) {
    const double k = 2e4, m = 0.3, z = dampingRatio(e);
    Spread spread;
    constexpr int phases = 500;
    for (int n = 0; n < phases; ++n) {
        const double found =
            integrated(1, k, m, z, contactTime(k, m, z) / perContact, (n + 0.5) / phases)
                .speedAfter;
        spread.lowest = std::min(spread.lowest, found);
        spread.mean += found / phases;
        spread.highest = std::max(spread.highest, found);
    }
    return spread;
}

}  // namespace

TEST_CASE("truth: the damping ratio gives the restitution back") {
    for (const double e : {0.01, 0.2, 0.5, 0.9, 0.999}) {
        CHECK(restitutionOf(dampingRatio(e)) == withinShare(e, 1e-12));
        CHECK(dampingRatio(e) < 1);
    }
    CHECK(dampingRatio(1) == 0);
}

TEST_CASE("truth: a penalty contact lasts, sinks in and rebounds as the closed forms say") {
    const double k = 2e4, m = 0.3, v = 1.5;
    for (const double e : {0.2, 0.5, 0.9, 1.0}) {
        CAPTURE(e);
        const double z = dampingRatio(e), duration = contactTime(k, m, z);
        const Bounce bounce = integrated(v, k, m, z, duration * 1e-5);
        CHECK(bounce.duration == withinShare(duration, 1e-4));
        CHECK(bounce.speedAfter == withinShare(e * v, 1e-3));
        CHECK(bounce.deepest == withinShare(deepestPenaltyOverlap(v, k, m, z), 1e-4));
        CHECK(stiffnessFor(bounce.deepest, v, m) >= k * (1 - 1e-4));
    }
    const double elastic = deepestPenaltyOverlap(v, k, m, 0);
    CHECK(stiffnessFor(elastic, v, m) == withinShare(k, 1e-12));
    // 20 steps a contact, in radii of 1 m.
    const double step = contactTime(stiffnessFor(0.01, v, m), m, 0) / 20;
    CHECK(v * step == withinShare(travelPerPenaltyStep(0.01), 1e-12));
}

TEST_CASE("truth: a spring stepped beyond 2 / omega blows up, just below it stays") {
    const double k = 50, m = 2, longest = longestStableStep(k, m);
    const auto largest = [&](double dt) {
        double x = 1, v = 0, most = 0;
        for (int n = 0; n < 5000; ++n) {
            v -= dt * k / m * x;
            x += dt * v;
            most = std::max(most, std::abs(x));
        }
        return most;
    };
    CHECK(largest(0.999 * longest) < 100);
    CHECK(largest(1.001 * longest) > 1e6);
}

TEST_CASE("truth: with 20 steps a contact the rebound is as wanted, with 3 it may gain energy") {
    for (const double e : {0.5, 0.9}) {
        CAPTURE(e);
        const Spread fine = restitutions(e, 20);
        CHECK(fine.mean == within(e, 0.006));
        CHECK(fine.lowest > e - 0.021);
        CHECK(fine.highest < e + 0.021);
    }
    CHECK(restitutions(0.2, 20).mean == within(0.184, 0.005));  // the harder damped, the less exact
    CHECK(restitutions(1, 3).highest == within(1.09, 0.01));
    CHECK(restitutions(1, 20).highest < 1.001);
}

TEST_CASE("truth: the restitution that steps leave tends to e, from a few per cent at 20 steps") {
    for (const double e : {0.3, 0.8, 1.0}) {
        CAPTURE(e);
        double lowest = 2, highest = 0;
        for (int k = 0; k < 100; ++k) {
            CHECK(std::abs(steppedRestitution(e, 1e5, 0.01 * k) - e) < 1e-4);
            lowest = std::min(lowest, steppedRestitution(e, 20, 0.01 * k));
            highest = std::max(highest, steppedRestitution(e, 20, 0.01 * k));
        }
        CHECK(lowest > e - 0.035);
        CHECK(highest < e + 0.035);
        if (e < 1) CHECK(highest - lowest > 0.005);  // by when in a step a contact begins
    }
}
