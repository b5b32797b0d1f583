// One round of a response by itself, without grid and step: from bodies and pairs on the host, and
// back. For chapter 07, whose scenes are a handful of balls with contacts named by hand.
#pragma once

#include <algorithm>
#include <limits>

#include "common/launch.cuh"
#include "common/response.h"
#include "common/spheres.h"

namespace ballpit {

class OneRound {
public:
    /// The pairs may come in any order, but first < second in each.
    OneRound(Device device, const Spheres& spheres, std::vector<Pair> pairs)
        : spheres_(spheres),
          from_(device, spheres.count()),
          to_(device, spheres.count()),
          list_(device, spheres.count(), pairs.size()),
          status_(device, 1, "status") {
        std::vector<Vec4> positions, velocities;
        std::vector<std::uint32_t> ids, starts(spheres.count() + 1, 0);
        for (std::size_t k = 0; k < spheres.count(); ++k) {
            positions.push_back(withW(spheres.positions[k], spheres.radii[k]));
            velocities.push_back(withW(spheres.velocities[k], 1.0f / spheres.masses[k]));
            ids.push_back(static_cast<std::uint32_t>(k));
        }
        from_.positions.upload(positions);
        from_.velocities.upload(velocities);
        from_.restitutions.upload(spheres.restitutions);
        from_.ids.upload(ids);
        std::sort(pairs.begin(), pairs.end());
        for (const Pair pair : pairs) ++starts[pair.first + 1];
        for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
        list_.pairs.upload(pairs);
        list_.starts.upload(starts);
        status_.fill(0);
    }

    /// The round as a response gets it. Both copies of the bodies share what never changes.
    ResponseRound round() {
        const BodiesView from = from_.view();
        const BodiesView to{to_.positions.view(), to_.velocities.view(), from.restitutions,
                            from.ids};
        const float unlimited = std::numeric_limits<float>::max();
        return {static_cast<int>(spheres_.count()),
                from,
                to,
                list_.view(),
                unlimited,
                1.0f,
                status_.view()};
    }

    /// The bodies after one round of `response`.
    Spheres resolve(Response& response) {
        response.resolve(round());
        return result();
    }

    /// The bodies as they lie in the round's `to`.
    Spheres result() const {
        Spheres result = spheres_;
        const std::vector<Vec4> positions = to_.positions.download();
        const std::vector<Vec4> velocities = to_.velocities.download();
        for (std::size_t k = 0; k < result.count(); ++k) {
            result.positions[k] = xyz(positions[k]);
            result.velocities[k] = xyz(velocities[k]);
        }
        return result;
    }

private:
    struct Bodies {
        Bodies(Device device, std::size_t count)
            : positions(device, count, "positions"),
              velocities(device, count, "velocities"),
              restitutions(device, count, "restitutions"),
              ids(device, count, "ids") {}
        BodiesView view() {
            return {positions.view(), velocities.view(), restitutions.view(), ids.view()};
        }
        DeviceBuffer<Vec4> positions, velocities;
        DeviceBuffer<float> restitutions;
        DeviceBuffer<std::uint32_t> ids;
    };

    Spheres spheres_;
    Bodies from_, to_;
    PairList list_;
    DeviceBuffer<StepStatus> status_;
};

}  // namespace ballpit
