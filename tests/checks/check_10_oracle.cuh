// What chapter 10's checks compare with: a whole step composed on the host, from motion in double
// precision, every ball against every other, and chapter 07's oracle. No grid, no copies, no
// repeats.
#pragma once

#include "10_full_system/physics_simulator.cuh"
#include "common/scene.h"
#include "tests/checks/canvas.h"
#include "tests/checks/check_07_oracle.cuh"

namespace ballpit::check {

using Pairs = std::vector<Pair>;

// ---- the stages by themselves

/// The stages of a step, to be called one by one, and what they leave behind.
class Probe : public EngineStages {
public:
    Probe(const Scene& scene, Device device, int rounds = 2)
        : EngineStages([&] {
              SimulatorSettings settings = settingsFor(scene, device);
              settings.iterations = rounds;
              return settings;
          }()) {
        bodies_.upload(scene.spheres);
        // As if other bodies had been sorted before.
        grid_.sortedHashes.fill(0);
        std::vector<std::uint32_t> backwards;
        for (int k = count_; k-- > 0;) backwards.push_back(static_cast<std::uint32_t>(k));
        grid_.sortedIndices.upload(backwards);
        beginReport();
    }

    StepStatus report() {
        sendReport();
        return status_.wait();
    }

    /// How many pairs were found.
    std::uint32_t found() const { return pairs_.starts.download().back(); }

    /// The listed pairs of the bodies in `copies`, by body number, first < second, sorted.
    Pairs pairs(Copies copies) {
        const std::vector<std::uint32_t> ids = bodies_.idsInMemoryOrder(copies);
        Pairs listed = pairs_.pairs.download(std::min(std::size_t(found()), pairs_.pairs.count()));
        for (Pair& pair : listed) {
            if (pair.first >= ids.size() || pair.second >= ids.size()) continue;
            const auto [low, high] = std::minmax(ids[pair.first], ids[pair.second]);
            pair = {low, high};
        }
        std::sort(listed.begin(), listed.end());
        return listed;
    }

    /// The stages before a search: the state is hashed and sorted into other copies.
    Copies sorted() {
        const Copies state = bodies_.state(), sorted = others(state);
        hash(state);
        buildGrid(state, sorted);
        return sorted;
    }

    static Copies others(Copies copies) {
        return {(copies.moving + 1) % 3, (copies.fixed + 1) % 3};
    }
};

/// The bodies in some copies. Fails, and returns nothing to compare, unless every body lies in one
/// slot there.
inline bool readCopies(Report& report, EngineStages& stages, Copies copies, Spheres& spheres) {
    const std::vector<std::uint32_t> ids = stages.bodies().idsInMemoryOrder(copies);
    std::vector<std::uint32_t> sorted = ids;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t k = 0; k < sorted.size(); ++k)
        if (sorted[k] != k) {
            report.fail(
                "where the stage should have written the bodies, body " +
                    text(std::min(k, sorted[k])) + " lies in how many slots?",
                text(std::size_t(std::count(ids.begin(), ids.end(), std::min(k, sorted[k])))), "1");
            return false;
        }
    const Copies state = stages.bodies().state();
    stages.bodies().commit(copies);
    spheres = stages.bodies().download();
    stages.bodies().commit(state);
    return true;
}

/// Bit for bit.
inline void requireUntouched(Report& report, const std::string& what, const Spheres& got,
                             const Spheres& expected) {
    if (stateHash(got) == stateHash(expected)) return;
    for (std::size_t k = 0; k < got.count(); ++k)
        if (!(length(got.positions[k] - expected.positions[k]) == 0.0f &&
              length(got.velocities[k] - expected.velocities[k]) == 0.0f))
            report.fail(what + ": position of body " + text(k), text(got.positions[k]),
                        text(expected.positions[k]));
}

// ---- the oracle

/// How a step is composed. Other values than these are mistakes.
struct StepRules {
    int rounds = 2;
    bool contacts = true, movesInEveryRound = false;
};

/// All touching pairs, by the rule of chapter 01 written out again.
inline Pairs everyPair(const Spheres& balls) {
    Pairs pairs;
    for (std::uint32_t a = 0; a < balls.count(); ++a)
        for (std::uint32_t b = a + 1; b < balls.count(); ++b) {
            const Vec3 p = balls.positions[a], q = balls.positions[b];
            const float dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z;
            const float reach = balls.radii[a] + balls.radii[b];
            if (dx * dx + dy * dy + dz * dz < reach * reach) pairs.push_back({a, b});
        }
    return pairs;
}

/// Gravity, damping, motion, and the walls one after the other.
inline void moveOnHost(Spheres& balls, const Scene& scene) {
    for (std::size_t k = 0; k < balls.count(); ++k) {
        const double dt = scene.dt, radius = balls.radii[k];
        const Vec3d velocity =
            (1 - scene.damping * dt) * (wide(balls.velocities[k]) + dt * wide(scene.gravity));
        const Vec3d position = wide(balls.positions[k]) + dt * velocity;
        double p[3] = {position.x, position.y, position.z};
        double v[3] = {velocity.x, velocity.y, velocity.z};
        const double low[3] = {scene.bounds.lower.x, scene.bounds.lower.y, scene.bounds.lower.z};
        const double high[3] = {scene.bounds.upper.x, scene.bounds.upper.y, scene.bounds.upper.z};
        for (int axis = 0; axis < 3; ++axis) {
            const double inside = std::clamp(p[axis], low[axis] + radius, high[axis] - radius);
            if ((inside - p[axis]) * v[axis] < 0) v[axis] *= -balls.restitutions[k];
            p[axis] = inside;
        }
        balls.positions[k] = narrow({p[0], p[1], p[2]});
        balls.velocities[k] = narrow({v[0], v[1], v[2]});
    }
}

/// What a round makes of the balls.
inline Spheres roundOnHost(const Spheres& balls) {
    return oracle({balls, everyPair(balls)}, {.split = true});
}

/// The balls after one step.
inline Spheres composedStep(const Scene& scene, const StepRules& rules) {
    Spheres balls = scene.spheres;
    moveOnHost(balls, scene);
    for (int round = 0; rules.contacts && round < rules.rounds; ++round) {
        if (round > 0 && rules.movesInEveryRound) moveOnHost(balls, scene);
        balls = roundOnHost(balls);
    }
    return balls;
}

/// Whether two balls touch or approach may hang on a rounding. Then the numbers of their contacts
/// do as well, and what each of these does: for which balls?
inline std::vector<bool> decidedByRounding(const Spheres& balls) {
    constexpr double little = 1e-5;  // m, m/s
    std::vector<bool> close(balls.count(), false);
    for (std::uint32_t a = 0; a < balls.count(); ++a)
        for (std::uint32_t b = a + 1; b < balls.count(); ++b) {
            const Line line = lineOf({a, b}, balls);
            const double reach = double(balls.radii[a]) + balls.radii[b];
            if (std::abs(line.distance - reach) < little ||
                (line.distance < reach && std::abs(line.speedA - line.speedB) < little))
                close[a] = close[b] = true;
        }
    std::vector<bool> decided = close;
    for (const auto [a, b] : everyPair(balls)) {
        if (close[a]) decided[b] = true;
        if (close[b]) decided[a] = true;
    }
    return decided;
}

inline bool sameBalls(const Spheres& got, const Spheres& expected) {
    for (std::size_t k = 0; k < got.count(); ++k)
        if (!(length(got.positions[k] - expected.positions[k]) < 1e-3f &&
              length(got.velocities[k] - expected.velocities[k]) < 1e-3f))
            return false;
    return true;
}

inline Vec3 rowPlace(int row, float x) { return {x, 1.1f * static_cast<float>(row) - 2.2f, 0}; }

/// Five rows of four equal balls, seen from the side. In each the first flies at the next and hits
/// it in this step; the others touch already. A round passes the blow on by one ball.
inline Scene rowsOfFour() {
    Scene scene{"rows", {}, {{-4, -4, -4}, {4, 4, 4}}, 2.0f, {0, 0, 0}, 0.0f, 0.1f};
    for (int row = 0; row < 5; ++row) {
        const float side = row % 2 == 0 ? 1.0f : -1.0f, speed = 2.0f + static_cast<float>(row);
        // After a tenth of a second the first overlaps the next by 2 cm, as these each other.
        const float start = -1.45f - 0.1f * speed;
        scene.spheres.add(rowPlace(row, side * start), {side * speed, 0, 0}, 0.5f, 1, 1);
        for (int k = 1; k < 4; ++k)
            scene.spheres.add(rowPlace(row, side * (-1.45f + 0.98f * static_cast<float>(k))), {},
                              0.5f, 1, 1);
    }
    return scene;
}

}  // namespace ballpit::check
