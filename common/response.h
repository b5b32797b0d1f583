// The interface of a collision response: touching pairs in, new velocities and positions out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/atomics.cuh"
#include "common/bodies.cuh"
#include "common/pair_list.cuh"

namespace ballpit {

/// One round's input and output. `from` is left as it is; `to` gets every body.
struct ResponseRound {
    int bodyCount;
    BodiesView from, to;
    PairsView pairs;
    float halfCell;     ///< m
    float motionShare;  ///< how much of (half a cell - radius) a body may move in this round
    View<StepStatus> status;
    bool newPairs = true;  ///< false: the same list as in the call before, and bodies in its order
};

/// Tells the host what a response must not keep to itself: a body that is no longer finite, or one
/// that moved (by `motion`, m) farther than the grid can follow in this round.
HD inline void reportMotion(int i, const ResponseRound& round, Vec3 motion, Vec3 position,
                            Vec3 velocity) {
    if (!isFinite(position) || !isFinite(velocity))
        lowerTo(round.status[0].notFiniteAfterImpulse, round.from.ids[i]);
    const float limit = round.motionShare * (round.halfCell - round.from.positions[i].w);
    // Every thread that gets here writes the same 1, so the order cannot show.
    if (lengthSquared(motion) > limit * limit) round.status[0].staleGrid = 1;
}

/// What a response wants of a step.
enum class StepKind {
    rounds,   ///< move once, then so many rounds of detect and resolve
    substeps  ///< move and resolve so many times, on one list of all pairs within reach; walls are
              ///< the response's then
};

/// A way of resolving collisions. One file an implementation, in solutions/07 and 11.
class Response {
public:
    virtual ~Response() = default;
    virtual StepKind stepKind() const { return StepKind::rounds; }
    /// The smallest restitution above 0 that it can give, or 0 if it can give any.
    virtual float leastRestitution() const { return 0.0f; }
    /// Enqueues the kernels of one round; never waits for the device.
    virtual void resolve(const ResponseRound& round) = 0;
    /// The last step was good and stays: what a response remembers of it counts from now on.
    virtual void commit() {}
    /// Makes room for `capacity` pairs.
    virtual void reserve(std::size_t capacity) = 0;
    /// Device bytes in use.
    virtual std::size_t bytes() const = 0;
};

}  // namespace ballpit
