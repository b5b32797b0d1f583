// Chapter 11: many small steps, each solved once, on one list of pairs (Macklin et al., "Small steps
// in physics simulation", 2019; Mueller et al., "Detailed rigid body simulation with extended
// position based dynamics", 2020). In each substep the bodies move freely; then contacts and walls
// push them apart, colour after colour; the velocity is what the motion came to, v = dx / h; and a
// last pass over the contacts that pushed gives each its bounce.
//
// An overlap that remains is speed in the next substep, so a pile holds itself up: error falls with
// the square of the substep. Where it fails: in a dense elastic gas the pushes of several
// contacts at once become velocities that no bounce accounts for.
#pragma once

#include "11_stability/colouring.cuh"
#include "11_stability/contact_rules.cuh"
#include "11_stability/reach.cuh"

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
    View<Vec4> corrections;  ///< by body: m; w: 1 / mass
    View<float> pushes;      ///< by pair: what it pushed in this substep, kg m
    float share;             ///< of an overlap, that a push takes away
};

HD inline void clearCorrection(int i, SmallStepView view) {
    view.corrections[i] = {0, 0, 0, view.round.from.velocities[i].w};
}

/// Pair k: pushes its balls apart if they overlap where they are now.
HD inline void pushApart(std::uint32_t k, SmallStepView view, bool firstPass) {
    const BodiesView& bodies = view.round.from;
    const auto [a, b] = view.round.pairs.pairs[k];
    if (firstPass) view.pushes[k] = 0.0f;
    const Vec4 sphereA = bodies.positions[a], sphereB = bodies.positions[b];
    Vec4 &changeA = view.corrections[a], &changeB = view.corrections[b];
    Vec3 line = (xyz(sphereB) - xyz(sphereA)) + (xyz(changeB) - xyz(changeA));
    const float reach = sphereA.w + sphereB.w;
    if (lengthSquared(line) >= reach * reach) return;
    if (lengthSquared(line) == 0.0f) line = lineOfCentres(a, b, bodies);
    const float distance = length(line);
    const float push = pushAlongNormal(view.share * (reach - distance), changeA.w + changeB.w);
    const Vec3 normal = (1.0f / distance) * line;
    changeA = withW(xyz(changeA) - (push * changeA.w) * normal, changeA.w);
    changeB = withW(xyz(changeB) + (push * changeB.w) * normal, changeB.w);
    view.pushes[k] += push;
}

/// Along one axis: how far a place is outside of [lower, upper], to be added to it.
HD inline float backInside(float place, float lower, float upper) {
    if (place < lower) return lower - place;
    if (place > upper) return upper - place;
    return 0.0f;
}

/// The walls push body i back.
HD inline void keepInside(int i, SmallStepView view, Bounds walls) {
    const Vec4 sphere = view.round.from.positions[i];
    Vec4& change = view.corrections[i];
    const float r = sphere.w;
    change.x += backInside(sphere.x + change.x, walls.lower.x + r, walls.upper.x - r);
    change.y += backInside(sphere.y + change.y, walls.lower.y + r, walls.upper.y - r);
    change.z += backInside(sphere.z + change.z, walls.lower.z + r, walls.upper.z - r);
}

/// Along one axis: the velocity of a body that came with `before` m/s and got to `place` freely. A
/// wall in its way reverses it, or, if it was slow, keeps it from going on. (Asking where the walls
/// have put the body instead would leave the answer to rounding.)
HD inline float bouncedOffWall(float velocity, float before, float place, float lower, float upper,
                               float restitution, float threshold) {
    const bool meetsLower = place < lower && before < 0.0f;
    const bool meetsUpper = place > upper && before > 0.0f;
    if (!meetsLower && !meetsUpper) return velocity;
    if (maximum(before, -before) > threshold) return -restitution * before;
    return meetsLower ? maximum(velocity, 0.0f) : minimum(velocity, 0.0f);
}

/// Body i's place, and its velocity from the way it made.
HD inline void velocityFromPositions(int i, SmallStepView view, SmallStepSettings settings) {
    const BodiesView &from = view.round.from, &to = view.round.to;
    const Vec4 sphere = from.positions[i], moving = from.velocities[i];
    const Vec3 change = xyz(view.corrections[i]);
    const Vec3 place = xyz(sphere) + change;
    Vec3 velocity = xyz(moving) + (1.0f / settings.h) * change;
    const float r = sphere.w, e = from.restitutions[i], least = settings.restitutionThreshold;
    const Bounds& walls = settings.walls;
    velocity.x = bouncedOffWall(velocity.x, moving.x, sphere.x, walls.lower.x + r,
                                walls.upper.x - r, e, least);
    velocity.y = bouncedOffWall(velocity.y, moving.y, sphere.y, walls.lower.y + r,
                                walls.upper.y - r, e, least);
    velocity.z = bouncedOffWall(velocity.z, moving.z, sphere.z, walls.lower.z + r,
                                walls.upper.z - r, e, least);
    to.positions[i] = withW(place, r);
    to.velocities[i] = withW(velocity, moving.w);
    reportMotion(i, view.round, change, place, velocity);
}

/// Pair k, if it pushed: its balls leave each other with e times the speed with which they met.
HD inline void restoreBounce(std::uint32_t k, SmallStepView view, float threshold) {
    const BodiesView &from = view.round.from, &to = view.round.to;
    if (view.pushes[k] == 0.0f) return;
    const auto [a, b] = view.round.pairs.pairs[k];
    const Contact met = contactBetween(a, b, from);
    float wanted = met.separation;
    if (met.separation < 0.0f)
        wanted = -restitutionAt(met.separation, a, b, from, threshold) * met.separation;
    Vec4 &velocityA = to.velocities[a], &velocityB = to.velocities[b];
    const float now = dot(xyz(velocityB) - xyz(velocityA), met.normal);
    const float impulse = (wanted - now) / (velocityA.w + velocityB.w);
    velocityA = withW(xyz(velocityA) - (impulse * velocityA.w) * met.normal, velocityA.w);
    velocityB = withW(xyz(velocityB) + (impulse * velocityB.w) * met.normal, velocityB.w);
}

class SmallSteps : public Response {
public:
    SmallSteps(Device device, std::size_t bodyCount, std::size_t pairCapacity,
               const SmallStepSettings& settings)
        : device_(device),
          settings_(settings),
          colouring_(device, bodyCount, pairCapacity),
          corrections_(device, bodyCount, "corrections"),
          pushes_(device, pairCapacity, "pairPushes") {}

    StepKind stepKind() const override { return StepKind::substeps; }

    void resolve(const ResponseRound& round) override {
        const SmallStepView view{round, corrections_.view(), pushes_.view(), 1.0f};
        if (round.newPairs) colouring_.colour(round.pairs);
        launch<clearCorrection>(device_, round.bodyCount, view);
        for (int pass = 0; pass < settings_.passes; ++pass) {
            colouring_.forEachPair<pushApart>(view, pass == 0);
            launch<keepInside>(device_, round.bodyCount, view, settings_.walls);
        }
        launch<velocityFromPositions>(device_, round.bodyCount, view, settings_);
        colouring_.forEachPair<restoreBounce>(view, settings_.restitutionThreshold);
    }
    void reserve(std::size_t pairCapacity) override {
        colouring_.reserve(pairCapacity);
        pushes_.resize(pairCapacity);
    }
    std::size_t bytes() const override {
        return colouring_.bytes() + corrections_.bytes() + pushes_.bytes();
    }
    static std::size_t predictedBytes(std::size_t bodyCount, std::size_t pairCapacity) {
        return Colouring::predictedBytes(bodyCount, pairCapacity) + bodyCount * sizeof(Vec4) +
               pairCapacity * sizeof(float);
    }

private:
    Device device_;
    SmallStepSettings settings_;
    Colouring colouring_;
    DeviceBuffer<Vec4> corrections_;
    DeviceBuffer<float> pushes_;
};

}  // namespace ballpit
