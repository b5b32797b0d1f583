// RigidBodySystem: every body's state, on one device. Users see arrays numbered by body; inside,
// the bodies lie in cell order and packed (bodies.cuh), in three copies: the committed state that a
// step begins with, and two to work in. A step that fails half-way therefore loses nothing.
#pragma once

#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "common/algorithms.h"
#include "common/bodies.cuh"
#include "common/error.h"
#include "common/launch.cuh"
#include "common/spheres.h"

namespace ballpit {

// Kernels between the user's numbering and the slots. Slot i holds body ids[i].

HD inline void numberBody(int i, View<std::uint32_t> ids) {
    ids[i] = static_cast<std::uint32_t>(i);
}
HD inline void storeVector(int i, View<const std::uint32_t> ids, View<const Vec3> byBody,
                           View<Vec4> slots) {
    slots[i] = withW(byBody[ids[i]], slots[i].w);
}
HD inline void loadVector(int i, View<const std::uint32_t> ids, View<const Vec4> slots,
                          View<Vec3> byBody) {
    byBody[ids[i]] = xyz(slots[i]);
}
HD inline void storeInverseW(int i, View<const std::uint32_t> ids, View<const float> byBody,
                             View<Vec4> slots) {
    slots[i].w = 1.0f / byBody[ids[i]];
}
HD inline void storeW(int i, View<const std::uint32_t> ids, View<const float> byBody,
                      View<Vec4> slots) {
    slots[i].w = byBody[ids[i]];
}
HD inline void loadW(int i, View<const std::uint32_t> ids, View<const Vec4> slots,
                     View<float> byBody) {
    byBody[ids[i]] = slots[i].w;
}
HD inline void storeScalar(int i, View<const std::uint32_t> ids, View<const float> byBody,
                           View<float> slots) {
    slots[i] = byBody[ids[i]];
}
HD inline void loadScalar(int i, View<const std::uint32_t> ids, View<const float> slots,
                          View<float> byBody) {
    byBody[ids[i]] = slots[i];
}

class RigidBodySystem;

/// One property of all bodies, as an array numbered by body: bodies.radii.upload(values).
template <class T>
class BodyField {
public:
    using Fault = std::string (*)(T);
    BodyField(RigidBodySystem& bodies, const char* name, Fault fault)
        : bodies_(bodies), name_(name), fault_(fault) {}
    BodyField(const BodyField&) = delete;

    /// Sets the property of all bodies. InputError if the count is wrong or a value unusable,
    /// naming the first such body; nothing is changed then.
    void upload(std::span<const T> values);
    void upload(const std::vector<T>& values) { upload(std::span<const T>(values)); }
    std::vector<T> download();

    /// Throws what upload would throw.
    void check(std::span<const T> values) const;

private:
    RigidBodySystem& bodies_;
    const char* name_;
    Fault fault_;
};

class RigidBodySystem {
public:
    /// `count` bodies at the origin, at rest: radius 0, mass 1 kg, restitution 0, grey.
    RigidBodySystem(Device device, std::size_t count)
        : positions(*this, "positions", faultOfPosition),
          velocities(*this, "velocities", faultOfVelocity),
          radii(*this, "radii", faultOfRadius),
          masses(*this, "masses", faultOfMass),
          restitutions(*this, "restitutions", faultOfRestitution),
          colors(count, Vec3{0.7f, 0.7f, 0.7f}),
          device_(device),
          count_(count) {
        for (int copy = 0; copy < copyCount; ++copy) {
            moving_.push_back({{device, count, "positions"}, {device, count, "velocities"}});
            fixed_.push_back({{device, count, "restitutions"}, {device, count, "ids"}});
        }
        reset();
    }
    RigidBodySystem(const RigidBodySystem&) = delete;

    /// Which of the three copies hold something. Positions and velocities change in every stage,
    /// restitutions and ids only when the bodies are reordered, so the two rotate apart.
    struct Copies {
        std::size_t moving = 0, fixed = 0;
        bool operator==(const Copies&) const = default;
    };

    BodyField<Vec3> positions, velocities;
    BodyField<float> radii, masses, restitutions;
    std::vector<Vec3> colors;  ///< for pictures only, so they stay on the host
    Vec3 period;               ///< m: edges of a periodic box; 0 between walls

    std::size_t count() const { return count_; }
    Device device() const { return device_; }

    /// The largest radius, m, and the smallest restitution.
    float largestRadius() const { return largestRadius_; }
    float smallestRestitution() const { return smallestRestitution_; }

    /// Sets everything at once. InputError as for the fields; nothing is changed then.
    void upload(const Spheres& spheres) {
        positions.check(spheres.positions);
        velocities.check(spheres.velocities);
        radii.check(spheres.radii);
        masses.check(spheres.masses);
        restitutions.check(spheres.restitutions);
        if (spheres.colors.size() != count_)
            throw InputError("colors: " + std::to_string(spheres.colors.size()) + " values for " +
                             std::to_string(count_) + " bodies");
        positions.upload(spheres.positions);
        velocities.upload(spheres.velocities);
        radii.upload(spheres.radii);
        masses.upload(spheres.masses);
        restitutions.upload(spheres.restitutions);
        colors = spheres.colors;
    }
    Spheres download() {
        return {positions.download(), velocities.download(),   radii.download(),
                masses.download(),    restitutions.download(), colors};
    }

    /// The body in each slot of the committed state, or of the given copy.
    std::vector<std::uint32_t> idsInMemoryOrder() { return idsInMemoryOrder(state_); }
    std::vector<std::uint32_t> idsInMemoryOrder(Copies copies) {
        return fixed_[copies.fixed].ids.download();
    }

    // For the engine: the copies.

    static constexpr int copyCount = 3;

    Copies state() const { return state_; }
    void commit(Copies copies) { state_ = copies; }
    BodiesView view(Copies copies) {
        MovingArrays& moving = moving_[copies.moving];
        FixedArrays& fixed = fixed_[copies.fixed];
        return {moving.positions.view(), moving.velocities.view(), fixed.restitutions.view(),
                fixed.ids.view(), withW(period, 0)};
    }

    std::size_t bytes() const {
        return copyCount * (moving_[0].positions.bytes() + moving_[0].velocities.bytes() +
                            fixed_[0].restitutions.bytes() + fixed_[0].ids.bytes());
    }
    static std::size_t predictedBytes(std::size_t count) {
        return copyCount * count * (2 * sizeof(Vec4) + sizeof(float) + sizeof(std::uint32_t));
    }

private:
    template <class T>
    friend class BodyField;

    struct MovingArrays {
        DeviceBuffer<Vec4> positions, velocities;
    };
    struct FixedArrays {
        DeviceBuffer<float> restitutions;
        DeviceBuffer<std::uint32_t> ids;
    };

    void reset() {
        for (MovingArrays& copy : moving_) copy.positions.fill(0), copy.velocities.fill(0);
        for (FixedArrays& copy : fixed_) copy.restitutions.fill(0);
        launch<numberBody>(device_, static_cast<int>(count_), fixed_[0].ids.view());
        masses.upload(std::vector<float>(count_, 1.0f));
    }

    // How each property gets to the slots and back. Fields are told apart by their address.

    void store(const BodyField<Vec3>& field, std::span<const Vec3> values) {
        DeviceBuffer<Vec3> byBody(device_, count_, "vectors by body");
        byBody.upload(values);
        launch<storeVector>(device_, intCount(), view(state_).ids, byBody.view(), slotsOf(field));
        synchronize(device_);
    }
    std::vector<Vec3> load(const BodyField<Vec3>& field) {
        DeviceBuffer<Vec3> byBody(device_, count_, "vectors by body");
        launch<loadVector>(device_, intCount(), view(state_).ids, slotsOf(field), byBody.view());
        return byBody.download();
    }
    View<Vec4> slotsOf(const BodyField<Vec3>& field) {
        return &field == &positions ? view(state_).positions : view(state_).velocities;
    }

    void store(const BodyField<float>& field, std::span<const float> values) {
        DeviceBuffer<float> byBody(device_, count_, "scalars by body");
        byBody.upload(values);
        const BodiesView state = view(state_);
        if (&field == &restitutions) {
            smallestRestitution_ = std::accumulate(values.begin(), values.end(), 1.0f, minimum);
            launch<storeScalar>(device_, intCount(), state.ids, byBody.view(), state.restitutions);
        } else if (&field == &masses) {
            launch<storeInverseW>(device_, intCount(), state.ids, byBody.view(), state.velocities);
            massesByBody_.assign(values.begin(), values.end());
        } else {
            launch<storeW>(device_, intCount(), state.ids, byBody.view(), state.positions);
            largestRadius_ = reduceMaximum(device_, intCount(), byBody.data(), scratch_);
        }
        synchronize(device_);
    }
    std::vector<float> load(const BodyField<float>& field) {
        // The slots hold 1 / mass, which does not give every mass back to the last bit.
        if (&field == &masses) return massesByBody_;
        DeviceBuffer<float> byBody(device_, count_, "scalars by body");
        const BodiesView state = view(state_);
        if (&field == &restitutions)
            launch<loadScalar>(device_, intCount(), state.ids, state.restitutions, byBody.view());
        else
            launch<loadW>(device_, intCount(), state.ids, state.positions, byBody.view());
        return byBody.download();
    }

    int intCount() const { return static_cast<int>(count_); }

    Device device_;
    std::size_t count_;
    std::vector<MovingArrays> moving_;
    std::vector<FixedArrays> fixed_;
    Copies state_;
    std::vector<float> massesByBody_;
    float largestRadius_ = 0.0f, smallestRestitution_ = 0.0f;
    Scratch scratch_{device_, 0, "scratch"};
};

template <class T>
void BodyField<T>::check(std::span<const T> values) const {
    if (values.size() != bodies_.count())
        throw InputError(std::string(name_) + ": " + std::to_string(values.size()) +
                         " values for " + std::to_string(bodies_.count()) + " bodies");
    for (std::size_t k = 0; k < values.size(); ++k) {
        const std::string fault = fault_(values[k]);
        if (!fault.empty()) throw InputError("body " + std::to_string(k) + ": " + fault);
    }
}

template <class T>
void BodyField<T>::upload(std::span<const T> values) {
    check(values);
    bodies_.store(*this, values);
}

template <class T>
std::vector<T> BodyField<T>::download() {
    return bodies_.load(*this);
}

}  // namespace ballpit
