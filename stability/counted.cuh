// A run of the coloured response in which the impulses that it gives are counted: the collisions of
// a gas, as theory counts them. (A contact that lasts for several steps is one collision; one that
// other contacts turn around within a step is several.)
#pragma once

#include "stability/trial.cuh"

namespace ballpit::stability {

/// Pair k, in place, as resolvePair does it.
HD inline void resolveAndCount(std::uint32_t k, ResponseRound round, ContactRules rules,
                               View<unsigned long long> impulses) {
    const auto [a, b] = round.pairs.pairs[k];
    if (contactBetween(a, b, round.to).separation < 0.0f) add(impulses[0], 1ull);
    resolvePair(k, round, rules);
}

class CountedColouredResponse : public ColouredResponse {
public:
    CountedColouredResponse(Device device, std::size_t bodyCount, std::size_t pairCapacity,
                            const ContactRules& rules)
        : ColouredResponse(device, bodyCount, pairCapacity, rules),
          impulses_(device, 1, "impulses") {
        impulses_.fill(0);
    }
    void resolve(const ResponseRound& round) override {
        resolveWith<resolveAndCount>(round, impulses_.view());
    }
    /// Given so far; also in a step that was repeated, so look at StepStats::gridRebuilt.
    double impulses() const { return static_cast<double>(impulses_.download()[0]); }

private:
    DeviceBuffer<unsigned long long> impulses_;
};

class CountedTrial : public Trial {
public:
    /// `settings` for the coloured response.
    CountedTrial(const Scene& scene, const SimulatorSettings& settings) : Trial(scene, settings) {
        const SimulatorSettings& s = this->settings();
        auto counted = std::make_unique<CountedColouredResponse>(
            s.device, scene.spheres.count(), pairs_.pairs.count(),
            ContactRules{*s.relaxation, *s.positionShare, *s.restitutionThreshold});
        counted_ = counted.get();
        response_ = std::move(counted);
    }
    double collisions() const { return counted_->impulses(); }

private:
    CountedColouredResponse* counted_;
};

}  // namespace ballpit::stability
