// The interface of a collision response: touching pairs in, new velocities and positions out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/algorithms.h"
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
};

/// A way of resolving collisions. One file an implementation, in solutions/07 and 11.
class Response {
public:
    virtual ~Response() = default;
    /// Enqueues the kernels of one round; never waits for the device.
    virtual void resolve(const ResponseRound& round, Scratch& scratch) = 0;
    /// Makes room for `capacity` pairs.
    virtual void reserve(std::size_t capacity) = 0;
    /// Device bytes in use.
    virtual std::size_t bytes() const = 0;
};

}  // namespace ballpit
