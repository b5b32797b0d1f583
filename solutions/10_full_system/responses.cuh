// Chapter 10: which response a simulator uses, and how much memory it will take.
#pragma once

#include <memory>

#include "07_impulse_response/atomic_response.cuh"
#include "07_impulse_response/impulse_response.cuh"
#include "07_impulse_response/racy_response.cuh"
#include "10_full_system/simulator_settings.h"
#include "11_stability/coloured_response.cuh"
#include "11_stability/jacobi_response.cuh"
#include "11_stability/penalty.cuh"
#include "11_stability/small_steps.cuh"
#include "11_stability/warm_response.cuh"

namespace ballpit {

/// The response of `s`, whose knobs are completed.
inline std::unique_ptr<Response> makeResponse(const SimulatorSettings& s) {
    const auto bodies = static_cast<std::size_t>(s.objects);
    const std::size_t pairs = s.firstPairCapacity();
    const float h = s.dt / static_cast<float>(*s.substeps);
    const ContactRules rules{*s.relaxation, *s.positionShare, *s.restitutionThreshold};
    switch (s.response) {
        case ResponseMethod::massSplit:
            return std::make_unique<ImpulseResponse>(s.device, bodies, pairs);
        case ResponseMethod::racy:
            return std::make_unique<RacyResponse>(s.device);
        case ResponseMethod::atomic:
            return std::make_unique<AtomicResponse>(s.device);
        case ResponseMethod::jacobi:
            return std::make_unique<JacobiResponse>(s.device, bodies, pairs, rules);
        case ResponseMethod::coloured:
            return std::make_unique<ColouredResponse>(s.device, bodies, pairs, rules);
        case ResponseMethod::warm:
            return std::make_unique<WarmResponse>(s.device, bodies, pairs,
                                                  WarmSettings{h, *s.iterations, *s.positionShare,
                                                               *s.restitutionThreshold, s.bounds});
        case ResponseMethod::smallSteps:
            return std::make_unique<SmallSteps>(
                s.device, bodies, pairs,
                SmallStepSettings{h, *s.iterations, *s.restitutionThreshold, s.bounds});
        case ResponseMethod::penalty:
            return std::make_unique<PenaltyResponse>(s.device, bodies, pairs, h, s.bounds);
    }
    throw std::logic_error("a response without a case");
}

/// Device bytes of the response before it has grown.
inline std::size_t predictedResponseBytes(const SimulatorSettings& s) {
    const auto bodies = static_cast<std::size_t>(s.objects);
    const std::size_t pairs = s.firstPairCapacity();
    switch (s.response) {
        case ResponseMethod::racy:
        case ResponseMethod::atomic:
            return 0;
        case ResponseMethod::massSplit:
        case ResponseMethod::jacobi:
            return ImpulseResponse::predictedBytes(bodies, pairs);
        case ResponseMethod::coloured:
            return Colouring::predictedBytes(bodies, pairs);
        case ResponseMethod::warm:
            return WarmResponse::predictedBytes(bodies, pairs);
        case ResponseMethod::smallSteps:
            return SmallSteps::predictedBytes(bodies, pairs);
        case ResponseMethod::penalty:
            return ContactLists::predictedBytes(bodies, pairs);
    }
    throw std::logic_error("a response without a case");
}

}  // namespace ballpit
