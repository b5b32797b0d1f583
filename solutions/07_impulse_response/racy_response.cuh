// Chapter 07's first exhibit: the original design's response, taken literally: every pair changes
// both of its bodies in place, all pairs at once. Two pairs that share a body read and write it at
// the same time; updates get lost, momentum leaks, and no two runs agree. Kept to show that.
#pragma once

#include "07_impulse_response/contact.cuh"
#include "common/launch.cuh"
#include "common/response.h"

namespace ballpit {

/// The round starts from a copy, since the engine never overwrites the state a step began with.
HD inline void copyBody(int i, BodiesView from, BodiesView to) {
    to.positions[i] = from.positions[i];
    to.velocities[i] = from.velocities[i];
}

/// The bodies of a pair once their contact is resolved.
struct ResolvedPair {
    Vec4 sphereA, velocityA, sphereB, velocityB;
};

HD inline ResolvedPair resolved(Pair pair, const BodiesView& bodies) {
    const auto [a, b] = pair;
    const PairEffect effect = effectOfPair(a, b, bodies);
    const auto changed = [](Vec4 before, float factor, Vec3 change) {
        return withW(xyz(before) + factor * change, before.w);
    };
    const float inverseMassA = bodies.velocities[a].w, inverseMassB = bodies.velocities[b].w;
    return {changed(bodies.positions[a], -inverseMassA, effect.push),
            changed(bodies.velocities[a], -inverseMassA, effect.impulse),
            changed(bodies.positions[b], inverseMassB, effect.push),
            changed(bodies.velocities[b], inverseMassB, effect.impulse)};
}

HD inline void store(Pair pair, const ResolvedPair& result, const BodiesView& bodies) {
    bodies.positions[pair.first] = result.sphereA;
    bodies.velocities[pair.first] = result.velocityA;
    bodies.positions[pair.second] = result.sphereB;
    bodies.velocities[pair.second] = result.velocityB;
}

//@show racy
/// All pairs of body i, in place. This is the race: between a thread's reading and its writing,
/// other threads read and write the same bodies.
HD inline void collisionResponseRacy(int i, ResponseRound round) {
    for (std::uint32_t k = round.pairs.starts[i]; k < round.pairs.endOf(i); ++k) {
        const Pair pair = round.pairs.pairs[k];
        const ResolvedPair result = resolved(pair, round.to);  // reads both bodies
        store(pair, result, round.to);                         // writes both bodies
    }
}
//@end

/// The same race, staged so that everyone sees the same: 32 pairs read before any of them writes,
/// as the 32 threads of a GPU's warp may. One thread plays them all.
HD inline void collisionResponseInWarps(int, ResponseRound round) {
    constexpr std::uint32_t warpSize = 32;
    ResolvedPair results[warpSize];
    const std::uint32_t stored = round.pairs.stored();
    for (std::uint32_t first = 0; first < stored; first += warpSize) {
        const std::uint32_t size = stored - first < warpSize ? stored - first : warpSize;
        for (std::uint32_t t = 0; t < size; ++t)
            results[t] = resolved(round.pairs.pairs[first + t], round.to);
        for (std::uint32_t t = 0; t < size; ++t)
            store(round.pairs.pairs[first + t], results[t], round.to);
    }
}

/// Reports what collisionResponse reports, after the fact.
HD inline void reportRound(int i, ResponseRound round) {
    const Vec3 before = xyz(round.from.positions[i]), after = xyz(round.to.positions[i]);
    reportMotion(i, round, after - before, after, xyz(round.to.velocities[i]));
}

/// In place, in parallel, without atomics. `staged` plays the race on one thread, warp by warp.
class RacyResponse : public Response {
public:
    explicit RacyResponse(Device device, bool staged = false) : device_(device), staged_(staged) {}

    void resolve(const ResponseRound& round) override {
        launch<copyBody>(device_, round.bodyCount, round.from, round.to);
        if (staged_)
            launch<collisionResponseInWarps>(device_, 1, round);
        else
            launch<collisionResponseRacy>(device_, round.bodyCount, round);
        launch<reportRound>(device_, round.bodyCount, round);
    }
    void reserve(std::size_t) override {}
    std::size_t bytes() const override { return 0; }

private:
    Device device_;
    bool staged_;
};

}  // namespace ballpit
