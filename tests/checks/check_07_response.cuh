// Chapter 07's checks of the response: scenes of a few balls, energy and momentum.
#pragma once

#include "tests/checks/check_07_contact.cuh"

namespace ballpit::check {

constexpr Version versions[] = {Version::inPlace, Version::atomic, Version::gathered};
/// Those that the student finishes.
constexpr Version mine[] = {Version::atomic, Version::gathered};

// ---- scenes of a few balls

inline Example pairOf(Vec3 velocityA, float massA, Vec3 velocityB, float massB, float restitution) {
    Example example{{}, {{0, 1}}};
    example.balls.add({0, 0, 0}, velocityA, 0.5f, massA, restitution);
    example.balls.add({1, 0, 0}, velocityB, 0.5f, massB, restitution);
    return example;
}

/// The same balls, numbered the other way round.
inline Example swapped(const Example& example) {
    Example result = example;
    Spheres& balls = result.balls;
    std::reverse(balls.positions.begin(), balls.positions.end());
    std::reverse(balls.velocities.begin(), balls.velocities.end());
    std::reverse(balls.radii.begin(), balls.radii.end());
    std::reverse(balls.masses.begin(), balls.masses.end());
    std::reverse(balls.restitutions.begin(), balls.restitutions.end());
    const auto last = static_cast<std::uint32_t>(balls.count()) - 1;
    for (Pair& pair : result.pairs) pair = {last - pair.second, last - pair.first};
    return result;
}

/// Gathered without its sign, a pair acts on its first ball as on its second: known by the lesson's
/// two balls.
inline Mistake signForgotten(Device device) {
    return {"the sign was forgotten: a pair acts on its first ball against the normal", [device] {
                const Spheres after = resolvedBy(Version::gathered, device, twoBalls());
                return length(after.velocities[0] - Vec3{4.92f, 1.44f, 0}) < 1e-4f ||
                       length(after.positions[0] - Vec3{0.08f / 3, 0.02f, 0}) < 1e-5f;
            }};
}

inline void twoBallsMeet(Report& report) {
    struct Row {
        const char* what;
        Example example;
        Vec3 velocityA, velocityB;
    };
    const Row rows[] = {
        {"1 kg and 1 kg, elastic", pairOf({2, 0, 0}, 1, {-1, 0, 0}, 1, 1), {-1, 0, 0}, {2, 0, 0}},
        {"1 kg and 3 kg, elastic",
         pairOf({2, 0, 0}, 1, {-1, 0, 0}, 3, 1),
         {-2.5f, 0, 0},
         {0.5f, 0, 0}},
        {"1 kg and 3 kg, no bounce",
         pairOf({2, 0, 0}, 1, {-2, 0, 0}, 3, 0),
         {-1, 0, 0},
         {-1, 0, 0}},
        {"the sideways part stays", pairOf({2, 5, 0}, 1, {0, 0, 7}, 1, 1), {0, 5, 0}, {2, 0, 7}},
        {"leaving each other", pairOf({-1, 0, 0}, 1, {2, 0, 0}, 1, 1), {-1, 0, 0}, {2, 0, 0}},
        {"the lesson's example", twoBalls(), {1.08f, -1.44f, 0}, {0.96f, 0.72f, 0}}};
    for (const Row& row : rows)
        for (const Version version : versions) {
            const std::string where = std::string(name(version)) + ", " + row.what;
            const Spheres after = resolvedBy(version, report.device, row.example);
            requireNear(report, where + ": velocity of ball 0", after.velocities[0], row.velocityA);
            requireNear(report, where + ": velocity of ball 1", after.velocities[1], row.velocityB);
            const Spheres other = resolvedBy(version, report.device, swapped(row.example));
            requireNear(report, where + ", numbers swapped: velocity of ball 1",
                        other.velocities[1], row.velocityA);
        }
    for (const Version version : versions) {
        const Spheres after = resolvedBy(version, report.device, twoBalls());
        const float gap = length(after.positions[1] - after.positions[0]);
        requireNear(report, std::string(name(version)) + ": distance after the push, m", gap, 1.0);
        requireNear(report, std::string(name(version)) + ": ball 0 gives way", after.positions[0],
                    {-0.08f / 3, -0.02f, 0});
    }
    report.guess({signForgotten(report.device)});
}

/// What computePairImpulse stores for each pair.
inline void splitMasses(Report& report) {
    // A hub of 2 kg with three balls of 1 kg, 0.9 m off. Two approach, the third leaves.
    Example star{{}, {{0, 1}, {0, 2}, {0, 3}}};
    star.balls.add({0, 0, 0}, {0, 0, 0}, 0.5f, 2, 1);
    star.balls.add({0.9f, 0, 0}, {-1, 0, 0}, 0.5f, 1, 1);
    star.balls.add({-0.9f, 0, 0}, {2, 0, 0}, 0.5f, 1, 1);
    star.balls.add({0, 0.9f, 0}, {0, 1, 0}, 0.5f, 1, 1);
    const Device device = report.device;
    OneRound bodies(device, star.balls, star.pairs);
    const ResponseRound round = bodies.round();
    ContactLists lists(device, 4, 3);
    DeviceBuffer<ContactCounts> counts(device, 4, "contactCounts");
    DeviceBuffer<Vec4> impulses(device, 3, "pairImpulses");
    DeviceBuffer<float> pushes(device, 3, "pairPushes");
    counts.fill(0);
    const ImpulseView view{lists.view(round.pairs), counts.view(), impulses.view(), pushes.view()};
    launch<linkAndCount>(device, 4, round.from, view);
    launch<computePairImpulse>(device, 4, round.from, view);
    const std::vector<Vec4> got = impulses.download();
    // The hub counts as 1 kg (2 approach) for impulses, as 2/3 kg (3 touch) for pushes.
    const float expected[] = {1, 2, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        requireNear(report, "impulse of pair " + text(star.pairs[k]), got[k].w, expected[k]);
        requireNear(report, "push of pair " + text(star.pairs[k]), pushes.download()[k], 0.04);
    }
    const auto isFirst = [&](float impulse) { return std::abs(got[0].w - impulse) < 1e-4f; };
    report.guess({{"a plain pair: the counts are not used", [&] { return isFirst(2 / 1.5f); }},
                  {"the counts of touching contacts were used for impulses: only approaching ones "
                   "take a share",
                   [&] { return isFirst(0.8f); }},
                  {"divided by the count: half the mass is twice the inverse mass",
                   [&] { return isFirst(1.6f); }}});
}

// ---- energy

/// A hub that comes down with 1 m/s on k balls at rest, all lines of centres with the cosine c to
/// its way.
inline Example coneOf(int k, double c, float hubMass, float spokeMass, float restitution) {
    Example example;
    const double s = std::sqrt(1 - c * c);
    for (int spoke = 0; spoke < k; ++spoke) {
        const double angle = 6.283185307 * spoke / k;
        example.balls.add(narrow({s * std::cos(angle), -c, s * std::sin(angle)}), {}, 0.5f,
                          spokeMass, restitution);
        example.pairs.push_back({std::uint32_t(spoke), std::uint32_t(k)});
    }
    example.balls.add({0, 0, 0}, {0, -1, 0}, 0.5f, hubMass, restitution);
    return example;
}

inline void pocket(Report& report) {
    const auto gain = [&](Version version, const Example& example) {
        return kineticEnergy(resolvedBy(version, report.device, example)) /
               kineticEnergy(example.balls);
    };
    for (const int k : {1, 2, 3, 5})  // one alone must be hit head-on: nothing balances it
        for (const float mass : {0.1f, 1.0f, 10.0f})
            for (const float e : {0.0f, 0.5f, 1.0f}) {
                const double c = k == 1 ? 1.0 : 0.8, b = mass / (mass + 1.0), s = k * c * c;
                const Example cone = coneOf(k, c, 1, mass, e);
                const std::string where =
                    text(k) + " balls of " + text(mass) + " kg at rest, e " + text(e) + ": energy ";
                const double sum = 1 - (1 + e) * b * s * (2 - (1 + e) * (b * s + 1 - b));
                requireNear(report, where + "after / before, atomic", gain(Version::atomic, cone),
                            sum, 1e-4 * std::max(1.0, sum));
                const double split = gain(Version::gathered, cone);
                if (!(split <= 1 + 1e-5))
                    report.fail(where + "after / before, gathered", text(float(split)),
                                "at most 1");
            }
    const double sum = gain(Version::atomic, pocketOfThree());
    requireNear(report, "the pocket of three: energy after / before, atomic", sum, 3);
    char words[128];
    std::snprintf(words, sizeof words,
                  "one ball into a pocket of three: energy x %.3f with a plain sum, x %.3f with "
                  "split masses",
                  sum, gain(Version::gathered, pocketOfThree()));
    report.measured(words);
}

inline void conserved(Report& report) {
    for (const float e : {0.0f, 0.5f, 1.0f}) {
        const Example scene = randomScene(400, report.seed, e);
        for (const Version version : mine) {
            const Spheres after = resolvedBy(version, report.device, scene);
            const std::string where = std::string(name(version)) + ", e " + text(e) + ": ";
            requireNear(report, where + "momentum that came or went, kg m/s",
                        momentumBetween(scene.balls, after), 0,
                        momentumTolerance(scene.balls, after));
            const double before = kineticEnergy(scene.balls), now = kineticEnergy(after);
            if (version == Version::gathered && !(now <= before * (1 + 1e-6)))
                report.fail(where + "energy, J", text(float(now)),
                            "at most " + text(float(before)));
        }
        // Alone, an elastic pair keeps all its energy, a duller one loses some.
        const Example pair = pairOf({1, 2, 3}, 1.5f, {-2, 1, 0}, 4, e);
        const double before = kineticEnergy(pair.balls);
        const double lost = 0.5 * (1.5 * 4 / 5.5) * (1 - e * e) * 9;  // they meet with 3 m/s
        for (const Version version : versions)
            requireNear(
                report, std::string(name(version)) + ", one pair, e " + text(e) + ": energy, J",
                kineticEnergy(resolvedBy(version, report.device, pair)), before - lost, 1e-5);
    }
    report.guess({signForgotten(report.device)});
}

}  // namespace ballpit::check
