// Chapter 11: many small steps, each solved once, on one list of pairs (Macklin et al., "Small
// steps in physics simulation", 2019; Mueller et al., "Detailed rigid body simulation with extended
// position based dynamics", 2020). In each substep the bodies move freely; then contacts and walls
// push them apart, colour after colour; and the velocity is what the motion came to, v = dx / h.
// Contacts that bounce are excepted: the speed of their push is taken back, and they get chapter
// 07's impulse instead, one after the other, which keeps energy where e = 1.
//
// An overlap that remains is speed in the next substep, so a pile holds itself up: error falls with
// the square of the substep. That is also where it fails: balls that overlap from the start are
// thrown apart, and a crowd of them explodes.
#pragma once

#include "11_stability/colouring.cuh"
#include "11_stability/contact_rules.cuh"
#include "11_stability/reach.cuh"
#include "common/hole.cuh"

namespace ballpit {

struct SmallStepSettings {
    float h;                     ///< s: a substep
    int passes;                  ///< over the contacts in each
    float restitutionThreshold;  ///< m/s
    Bounds walls;                ///< m
};

/// What the kernels share. The bodies moved freely to round.from; a body's place in a pass is that
/// and its correction. Small numbers keep their digits when they are not added to large ones.
struct SmallStepView {
    ResponseRound round;
    View<Vec4> corrections;               ///< by body: m; w: 1 / mass
    View<std::uint32_t> wallsThatPushed;  ///< by body: two bits for x, y, z: lower, upper
    View<Vec4> pushes;  ///< by pair: what it pushed in this substep, kg m; w: 1 if it bounces
    float share;        ///< of an overlap, that a push takes away
};

HD inline void clearCorrection(int i, const SmallStepView& view) {
    view.corrections[i] = {0, 0, 0, view.round.from.velocities[i].w};
    view.wallsThatPushed[i] = 0;
}

/// Pair k: pushes its balls apart if they overlap where they are now.
HD inline void pushApart(std::uint32_t k, const SmallStepView& view, bool firstPass) {
    const BodiesView& bodies = view.round.from;
    const auto [a, b] = view.round.pairs.pairs[k];
    if (firstPass) view.pushes[k] = {};
    const Vec4 sphereA = bodies.positions[a], sphereB = bodies.positions[b];
    Vec4 &changeA = view.corrections[a], &changeB = view.corrections[b];
    Vec3 line = (xyz(sphereB) - xyz(sphereA)) + (xyz(changeB) - xyz(changeA));
    const float reach = sphereA.w + sphereB.w;
    if (lengthSquared(line) >= reach * reach) return;
    if (lengthSquared(line) == 0.0f) line = lineOfCentres(a, b, bodies);
    const float distance = length(line);
    const float size = pushAlongNormal(view.share * (reach - distance), changeA.w + changeB.w);
    const Vec3 push = (size / distance) * line;
    changeA = withW(xyz(changeA) - changeA.w * push, changeA.w);
    changeB = withW(xyz(changeB) + changeB.w * push, changeB.w);
    view.pushes[k] = withW(xyz(view.pushes[k]) + push, 0.0f);
}

/// Along one axis: brings a place back into [lower, upper]. Returns which wall pushed: 0, 1 or 2.
HD inline std::uint32_t pushInside(float place, float& change, float lower, float upper) {
    if (place + change < lower) {
        change += lower - (place + change);
        return 1;
    }
    if (place + change > upper) {
        change += upper - (place + change);
        return 2;
    }
    return 0;
}

/// The walls push body i back.
HD inline void keepInside(int i, const SmallStepView& view, Bounds walls) {
    const Vec4 sphere = view.round.from.positions[i];
    Vec4& change = view.corrections[i];
    const float r = sphere.w;
    view.wallsThatPushed[i] |=
        pushInside(sphere.x, change.x, walls.lower.x + r, walls.upper.x - r) |
        pushInside(sphere.y, change.y, walls.lower.y + r, walls.upper.y - r) << 2 |
        pushInside(sphere.z, change.z, walls.lower.z + r, walls.upper.z - r) << 4;
}

/// Body i's place, and its velocity from the way it made.
HD inline void velocityFromPositions(int i, const SmallStepView& view, float h) {
    const BodiesView &from = view.round.from, &to = view.round.to;
    const Vec4 sphere = from.positions[i], moving = from.velocities[i];
    const Vec3 change = xyz(view.corrections[i]), place = xyz(sphere) + change;
    // ---- hole small.velocity (about 1 line): Its velocity is the way it made, divided by the time it took
    TODO_HOLE("small.velocity");
    const Vec3 velocity = xyz(moving);
    // ---- end of small.velocity
    to.positions[i] = withW(place, sphere.w);
    to.velocities[i] = withW(velocity, moving.w);
    reportMotion(i, view.round, change, place, velocity);
}

/// Did the pair push, and does it meet too fast to be at rest? Then it bounces. With a threshold of
/// 0 nothing rests: then pairs count that part already and were pushed by others' pushes.
HD inline bool isLively(std::uint32_t k, const SmallStepView& view, float threshold) {
    if (lengthSquared(xyz(view.pushes[k])) == 0.0f) return false;
    const BodiesView& from = view.round.from;
    const auto [a, b] = view.round.pairs.pairs[k];
    if (combinedRestitution(from.restitutions[a], from.restitutions[b]) == 0.0f) return false;
    return threshold == 0.0f || contactBetween(a, b, from).separation < -threshold;
}

/// Changes the velocities of a pair's bodies by an impulse on the second.
HD inline void applyImpulse(Vec3 impulse, Vec4& velocityA, Vec4& velocityB) {
    velocityA = withW(xyz(velocityA) - velocityA.w * impulse, velocityA.w);
    velocityB = withW(xyz(velocityB) + velocityB.w * impulse, velocityB.w);
}

/// Pair k, if it is lively: takes back the speed that came from its push. An impulse will do that.
HD inline void takeBackPush(std::uint32_t k, const SmallStepView& view,
                            const SmallStepSettings& settings) {
    if (!isLively(k, view, settings.restitutionThreshold)) return;
    const auto [a, b] = view.round.pairs.pairs[k];
    // ---- hole small.take_back (about 2 lines): Minus the impulse that would have made the push in time h
    TODO_HOLE("small.take_back");
    // ---- end of small.take_back
    view.pushes[k].w = 1.0f;
}

/// Along one axis: the velocity of a body that came with `before` m/s, if a wall pushed it: it
/// bounces, or, if it was slow, does not go on; the push itself makes it no faster.
HD inline float bouncedOffWall(float velocity, float before, std::uint32_t wall, float restitution,
                               float threshold) {
    if (wall == 0) return velocity;
    const float inwards = wall == 1 ? 1.0f : -1.0f, approach = inwards * before;
    if (approach < -threshold) return -restitution * before;
    if (approach > threshold) return before;
    return inwards * maximum(inwards * velocity, 0.0f);
}

HD inline void settleWalls(int i, const SmallStepView& view, float threshold) {
    const std::uint32_t walls = view.wallsThatPushed[i];
    if (walls == 0) return;
    const Vec4 before = view.round.from.velocities[i];
    const float e = view.round.from.restitutions[i];
    Vec4& velocity = view.round.to.velocities[i];
    velocity.x = bouncedOffWall(velocity.x, before.x, walls & 3u, e, threshold);
    velocity.y = bouncedOffWall(velocity.y, before.y, walls >> 2 & 3u, e, threshold);
    velocity.z = bouncedOffWall(velocity.z, before.z, walls >> 4 & 3u, e, threshold);
}

/// Pair k, if it pushed. A lively one gets chapter 07's impulse, if it still approaches. Another
/// must not part faster than it did before the push.
HD inline void settlePair(std::uint32_t k, const SmallStepView& view) {
    const Vec4 push = view.pushes[k];
    if (lengthSquared(xyz(push)) == 0.0f) return;
    const BodiesView& from = view.round.from;
    const auto [a, b] = view.round.pairs.pairs[k];
    Vec4 &velocityA = view.round.to.velocities[a], &velocityB = view.round.to.velocities[b];
    const Contact met = contactBetween(a, b, from);
    const float now = dot(xyz(velocityB) - xyz(velocityA), met.normal);
    const float inverseMassSum = velocityA.w + velocityB.w;
    // ---- hole small.bounce (about 5 lines): The impulse: chapter 07's for a lively pair, no kick for another
    TODO_HOLE("small.bounce");
    const float impulse = 0.0f;
    // ---- end of small.bounce
    applyImpulse(impulse * met.normal, velocityA, velocityB);
}

class SmallSteps : public Response {
public:
    SmallSteps(Device device, std::size_t bodyCount, std::size_t pairCapacity,
               const SmallStepSettings& settings)
        : device_(device),
          settings_(settings),
          colouring_(device, bodyCount, pairCapacity),
          corrections_(device, bodyCount, "corrections"),
          wallsThatPushed_(device, bodyCount, "wallsThatPushed"),
          pushes_(device, pairCapacity, "pairPushes") {}

    StepKind stepKind() const override { return StepKind::substeps; }

    void resolve(const ResponseRound& round) override {
        const SmallStepView view{round, corrections_.view(), wallsThatPushed_.view(),
                                 pushes_.view(), 1.0f};
        if (round.newPairs) colouring_.colour(round.pairs);
        launch<clearCorrection>(device_, round.bodyCount, view);
        for (int pass = 0; pass < settings_.passes; ++pass) {
            colouring_.forEachPair<pushApart>(view, pass == 0);
            launch<keepInside>(device_, round.bodyCount, view, settings_.walls);
        }
        launch<velocityFromPositions>(device_, round.bodyCount, view, settings_.h);
        colouring_.forEachPair<takeBackPush>(view, settings_);
        launch<settleWalls>(device_, round.bodyCount, view, settings_.restitutionThreshold);
        colouring_.forEachPair<settlePair>(view);
    }
    void reserve(std::size_t pairCapacity) override {
        colouring_.reserve(pairCapacity);
        pushes_.resize(pairCapacity);
    }
    std::size_t bytes() const override {
        return colouring_.bytes() + corrections_.bytes() + wallsThatPushed_.bytes() +
               pushes_.bytes();
    }
    static std::size_t predictedBytes(std::size_t bodyCount, std::size_t pairCapacity) {
        return Colouring::predictedBytes(bodyCount, pairCapacity) +
               bodyCount * (sizeof(Vec4) + sizeof(std::uint32_t)) + pairCapacity * sizeof(Vec4);
    }

private:
    Device device_;
    SmallStepSettings settings_;
    Colouring colouring_;
    DeviceBuffer<Vec4> corrections_;
    DeviceBuffer<std::uint32_t> wallsThatPushed_;
    DeviceBuffer<Vec4> pushes_;
};

}  // namespace ballpit
