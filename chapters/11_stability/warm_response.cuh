// Chapter 11: accumulated impulses that start from those of the step before.
//
// Each contact keeps the sum of what it has given in this step. The sum may not become negative (a
// contact cannot pull), but a single change may: an impulse that turns out too large is taken back.
// And since a pile at rest needs the same impulses in every step, each step begins with those of
// the last one. So they need not travel from the floor to the top anew every time.
//
// A step: the bodies have moved freely; `passes` times all contacts correct the velocities, colour
// after colour, and the bodies go with what has been changed; then a part of each overlap is pushed
// away, which changes no velocity. A contact is allowed to close its gap in this step, not more.
//
// Where it fails: the bounces of all contacts of a step are fixed before the first impulse, so it
// finds one solution for all at once. In Newton's cradle that one is wrong, however many the
// passes.
#pragma once

#include "11_stability/small_steps.cuh"
#include "common/hole.cuh"

namespace ballpit {

struct WarmSettings {
    float h;                     ///< s: the step
    int passes;                  ///< over the contacts
    float positionShare;         ///< of each overlap
    float restitutionThreshold;  ///< m/s
    Bounds walls;                ///< m
};

/// Where a body's entries begin and end.
struct EntryRange {
    std::uint32_t begin, end;
};

/// The impulses of a step by the bodies' numbers, which outlive the sort. Body a's contacts are
/// entries ranges[a].begin to ranges[a].end - 1: with whom, and how much, N s.
struct RememberedView {
    View<EntryRange> ranges;
    View<std::uint32_t> partners;
    View<float> impulses;
    View<Vec4> walls;  ///< by body: what the walls gave, m/s along x, y, z
};

struct WarmView {
    SmallStepView motion;    ///< places and corrections, for the pushes at the end
    View<float> impulses;    ///< by pair: the sum so far, N s
    View<float> wanted;      ///< by pair: the least speed of separation, m/s
    View<Vec4> wallChanges;  ///< by slot: what the walls gave so far, m/s along x, y, z
    WarmSettings settings;
};

/// Body a's remembered impulse with body b; 0 if there is none.
HD inline float rememberedBy(std::uint32_t a, std::uint32_t b, const RememberedView& memory) {
    for (std::uint32_t k = memory.ranges[a].begin; k < memory.ranges[a].end; ++k)
        if (memory.partners[k] == b) return memory.impulses[k];
    return 0.0f;
}

/// Pair k: what it shall come to, and with what it begins. A pair that meets fast enough bounces;
/// another may come as near as to touch.
HD inline void beginPair(std::uint32_t k, const WarmView& view, const RememberedView& memory) {
    const BodiesView& bodies = view.motion.round.from;
    const auto [a, b] = view.motion.round.pairs.pairs[k];
    const Contact contact = contactBetween(a, b, bodies);
    const float restitution =
        restitutionAt(contact.separation, a, b, bodies, view.settings.restitutionThreshold);
    const bool bounces =
        contact.penetration > 0.0f && contact.separation < 0.0f && restitution > 0.0f;
    const float gapBefore = -contact.penetration - view.settings.h * contact.separation;
    view.wanted[k] =
        bounces ? -restitution * contact.separation : -maximum(gapBefore, 0.0f) / view.settings.h;
    const std::uint32_t idA = bodies.ids[a], idB = bodies.ids[b];
    view.impulses[k] = rememberedBy(idA, idB, memory) + rememberedBy(idB, idA, memory);
}

/// Pair k gives what it gave in the step before.
HD inline void warmStart(std::uint32_t k, const WarmView& view) {
    const float impulse = view.impulses[k];
    if (impulse == 0.0f) return;
    const auto [a, b] = view.motion.round.pairs.pairs[k];
    const BodiesView& to = view.motion.round.to;
    applyImpulse(impulse * contactBetween(a, b, view.motion.round.from).normal, to.velocities[a],
                 to.velocities[b]);
}

/// Pair k brings its bodies to the wanted speed, as far as its sum allows.
HD inline void accumulate(std::uint32_t k, const WarmView& view) {
    const auto [a, b] = view.motion.round.pairs.pairs[k];
    Vec4 &velocityA = view.motion.round.to.velocities[a],
         &velocityB = view.motion.round.to.velocities[b];
    const Vec3 normal = contactBetween(a, b, view.motion.round.from).normal;
    const float separation = dot(xyz(velocityB) - xyz(velocityA), normal);
    const float before = view.impulses[k];
    // ---- hole warm.clamp (about 2 lines): The sum after this pass: what is missing is added; no contact pulls
    TODO_HOLE("warm.clamp");
    const float after = before;
    // ---- end of warm.clamp
    view.impulses[k] = after;
    applyImpulse((after - before) * normal, velocityA, velocityB);
}

/// Along one axis: the same for the nearer wall. `came` is the velocity before any impulse, `place`
/// where that led; `sum` is what the wall has given so far.
HD inline void accumulateWall(float& velocity, float& sum, float came, float place, float lower,
                              float upper, float restitution, const WarmSettings& s) {
    // Towards the wall is negative on either side.
    const float side = place - lower < upper - place ? 1.0f : -1.0f;
    const float gap = side > 0.0f ? place - lower : upper - place;
    const float approach = side * came;
    float wanted = -maximum(gap - s.h * approach, 0.0f) / s.h;
    if (gap < 0.0f && approach < -s.restitutionThreshold) wanted = -restitution * approach;
    const float before = side * sum;
    const float after = maximum(before + wanted - side * velocity, 0.0f);
    velocity += side * (after - before);
    sum = side * after;
}

HD inline void accumulateWalls(int i, const WarmView& view) {
    const BodiesView &from = view.motion.round.from, &to = view.motion.round.to;
    const Vec4 sphere = from.positions[i], came = from.velocities[i];
    Vec4 &velocity = to.velocities[i], &sum = view.wallChanges[i];
    const float r = sphere.w, e = from.restitutions[i];
    const Bounds& walls = view.settings.walls;
    accumulateWall(velocity.x, sum.x, came.x, sphere.x, walls.lower.x + r, walls.upper.x - r, e,
                   view.settings);
    accumulateWall(velocity.y, sum.y, came.y, sphere.y, walls.lower.y + r, walls.upper.y - r, e,
                   view.settings);
    accumulateWall(velocity.z, sum.z, came.z, sphere.z, walls.lower.z + r, walls.upper.z - r, e,
                   view.settings);
}

/// Body i starts with the velocity it came with and what the walls gave in the step before.
HD inline void beginBody(int i, const WarmView& view, const RememberedView& memory) {
    const BodiesView &from = view.motion.round.from, &to = view.motion.round.to;
    const Vec4 sum = memory.walls[from.ids[i]], came = from.velocities[i];
    view.wallChanges[i] = sum;
    to.velocities[i] = withW(xyz(came) + xyz(sum), came.w);
}

/// Body i goes where the changed velocity leads: a correction to where it went freely.
HD inline void followVelocity(int i, const WarmView& view) {
    const ResponseRound& round = view.motion.round;
    const Vec4 came = round.from.velocities[i];
    const Vec3 change = xyz(round.to.velocities[i]) - xyz(came);
    view.motion.corrections[i] = withW(view.settings.h * change, came.w);
}

/// Body i's place, and what is to be remembered of its contacts. An impulse that made a bounce is
/// not needed again.
HD inline void finishBody(int i, const WarmView& view, const RememberedView& memory) {
    const ResponseRound& round = view.motion.round;
    const Vec4 sphere = round.from.positions[i];
    const Vec3 change = xyz(view.motion.corrections[i]), place = xyz(sphere) + change;
    round.to.positions[i] = withW(place, sphere.w);
    reportMotion(i, round, change, place, xyz(round.to.velocities[i]));

    const std::uint32_t id = round.from.ids[i];
    const std::uint32_t begin = round.pairs.starts[i], end = round.pairs.endOf(i);
    memory.ranges[id] = {begin, end};
    memory.walls[id] = view.wallChanges[i];
    for (std::uint32_t k = begin; k < end; ++k) {
        memory.partners[k] = round.from.ids[round.pairs.pairs[k].second];
        memory.impulses[k] = view.wanted[k] > 0.0f ? 0.0f : view.impulses[k];
    }
}

/// The impulses of one step.
class RememberedImpulses {
public:
    RememberedImpulses(Device device, std::size_t bodyCount, std::size_t pairCapacity)
        : ranges_(device, bodyCount, "rememberedRanges"),
          partners_(device, pairCapacity, "rememberedPartners"),
          impulses_(device, pairCapacity, "rememberedImpulses"),
          walls_(device, bodyCount, "rememberedWalls") {
        ranges_.fill(0);
        walls_.fill(0);
    }
    RememberedView view() {
        return {ranges_.view(), partners_.view(), impulses_.view(), walls_.view()};
    }
    /// Takes over what `other`, of the same size, remembers.
    void copy(const RememberedImpulses& other) {
        const Device device = ranges_.device();
        copyWithin(device, ranges_.data(), other.ranges_.data(), ranges_.bytes());
        copyWithin(device, walls_.data(), other.walls_.data(), walls_.bytes());
        copyWithin(device, partners_.data(), other.partners_.data(), other.partners_.bytes());
        copyWithin(device, impulses_.data(), other.impulses_.data(), other.impulses_.bytes());
    }
    std::size_t bytes() const {
        return ranges_.bytes() + partners_.bytes() + impulses_.bytes() + walls_.bytes();
    }

private:
    DeviceBuffer<EntryRange> ranges_;
    DeviceBuffer<std::uint32_t> partners_;
    DeviceBuffer<float> impulses_;
    DeviceBuffer<Vec4> walls_;
};

class WarmResponse : public Response {
public:
    WarmResponse(Device device, std::size_t bodyCount, std::size_t pairCapacity,
                 const WarmSettings& settings)
        : device_(device),
          settings_(settings),
          colouring_(device, bodyCount, pairCapacity),
          corrections_(device, bodyCount, "corrections"),
          wallChanges_(device, bodyCount, "wallChanges"),
          wallsThatPushed_(device, bodyCount, "wallsThatPushed"),
          pushes_(device, pairCapacity, "pairPushes"),
          impulses_(device, pairCapacity, "pairImpulses"),
          wanted_(device, pairCapacity, "wantedSpeeds"),
          committed_(device, bodyCount, pairCapacity),
          next_(device, bodyCount, pairCapacity) {}

    StepKind stepKind() const override { return StepKind::substeps; }

    void resolve(const ResponseRound& round) override {
        const int bodies = round.bodyCount;
        const WarmView view{{round, corrections_.view(), wallsThatPushed_.view(), pushes_.view(),
                             settings_.positionShare},
                            impulses_.view(),
                            wanted_.view(),
                            wallChanges_.view(),
                            settings_};
        colouring_.colour(round.pairs);
        colouring_.forEachPair<beginPair>(view, committed_.view());
        launch<beginBody>(device_, bodies, view, committed_.view());
        colouring_.forEachPair<warmStart>(view);
        for (int pass = 0; pass < settings_.passes; ++pass) {
            colouring_.forEachPair<accumulate>(view);
            launch<accumulateWalls>(device_, bodies, view);
        }
        launch<followVelocity>(device_, bodies, view);
        colouring_.forEachPair<pushApart>(view.motion, true);
        launch<keepInside>(device_, bodies, view.motion, settings_.walls);
        launch<finishBody>(device_, bodies, view, next_.view());
    }

    /// Until now the step could have been repeated from the same start.
    void commit() override { committed_.copy(next_); }

    void reserve(std::size_t pairCapacity) override {
        colouring_.reserve(pairCapacity);
        pushes_.resize(pairCapacity);
        impulses_.resize(pairCapacity);
        wanted_.resize(pairCapacity);
        RememberedImpulses larger(device_, corrections_.count(), pairCapacity);
        larger.copy(committed_);
        committed_ = std::move(larger);
        next_ = RememberedImpulses(device_, corrections_.count(), pairCapacity);
    }
    std::size_t bytes() const override {
        return colouring_.bytes() + corrections_.bytes() + wallChanges_.bytes() +
               wallsThatPushed_.bytes() + pushes_.bytes() + impulses_.bytes() + wanted_.bytes() +
               committed_.bytes() + next_.bytes();
    }
    static std::size_t predictedBytes(std::size_t bodyCount, std::size_t pairCapacity) {
        return Colouring::predictedBytes(bodyCount, pairCapacity) +
               bodyCount * (2 * (2 * sizeof(Vec4) + sizeof(EntryRange)) + sizeof(std::uint32_t)) +
               pairCapacity * (sizeof(Vec4) + 4 * sizeof(float) + 2 * sizeof(std::uint32_t));
    }

private:
    Device device_;
    WarmSettings settings_;
    Colouring colouring_;
    DeviceBuffer<Vec4> corrections_, wallChanges_;
    DeviceBuffer<std::uint32_t> wallsThatPushed_;
    DeviceBuffer<Vec4> pushes_;
    DeviceBuffer<float> impulses_, wanted_;
    RememberedImpulses committed_, next_;
};

}  // namespace ballpit
