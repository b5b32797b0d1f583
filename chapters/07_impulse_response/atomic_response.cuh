// Chapter 07's second exhibit: every pair reads the bodies as they were and adds its changes with
// float atomics. No update is lost, so momentum is kept. But float sums round otherwise in another
// order, so the last bits differ from run to run; and a plain sum of impulses can gain energy.
#pragma once

#include <atomic>

#include "07_impulse_response/racy_response.cuh"
#include "common/hole.cuh"

namespace ballpit {

/// Adds to a float that other threads add to as well. On a CPU: add to what was seen and store
/// that, unless the float has changed meanwhile; then look again.
HD inline void addAtomically(float& target, float value) {
#ifdef __CUDA_ARCH__
    atomicAdd(&target, value);
#else
    const std::atomic_ref place(target);
    float seen = place.load(std::memory_order_relaxed);
    while (!place.compare_exchange_weak(seen, seen + value, std::memory_order_relaxed)) {
    }
#endif
}

/// Adds to x, y, z, one after the other: only the sum of all threads is right, not each moment.
HD inline void addAtomically(Vec4& target, Vec3 change) {
    addAtomically(target.x, change.x);
    addAtomically(target.y, change.y);
    addAtomically(target.z, change.z);
}

/// All pairs of body i: reads the snapshot `from`, adds to `to`.
HD inline void collisionResponseAtomic(int i, ResponseRound round) {
    const BodiesView &from = round.from, &to = round.to;
    for (std::uint32_t k = round.pairs.starts[i]; k < round.pairs.endOf(i); ++k) {
        const auto [a, b] = round.pairs.pairs[k];
        const float inverseMassA = from.velocities[a].w, inverseMassB = from.velocities[b].w;
        // ---- hole response.atomic (about 5 lines): Add the pair's effect to both bodies, atomically
        TODO_HOLE("response.atomic");
        // ---- end of response.atomic
    }
}

/// A snapshot, and a sum by float atomics.
class AtomicResponse : public Response {
public:
    explicit AtomicResponse(Device device) : device_(device) {}

    void resolve(const ResponseRound& round) override {
        launch<copyBody>(device_, round.bodyCount, round.from, round.to);
        launch<collisionResponseAtomic>(device_, round.bodyCount, round);
        launch<reportRound>(device_, round.bodyCount, round);
    }
    void reserve(std::size_t) override {}
    std::size_t bytes() const override { return 0; }

private:
    Device device_;
};

}  // namespace ballpit
