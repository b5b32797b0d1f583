// Chapter 10: which response a simulator uses, and how much memory it will take.
#pragma once

#include <memory>

#include "07_impulse_response/atomic_response.cuh"
#include "07_impulse_response/impulse_response.cuh"
#include "07_impulse_response/racy_response.cuh"
#include "10_full_system/simulator_settings.h"

namespace ballpit {

inline std::unique_ptr<Response> makeResponse(const SimulatorSettings& s) {
    if (s.response == ResponseMethod::racy) return std::make_unique<RacyResponse>(s.device);
    if (s.response == ResponseMethod::atomic) return std::make_unique<AtomicResponse>(s.device);
    return std::make_unique<ImpulseResponse>(s.device, static_cast<std::size_t>(s.objects),
                                             s.firstPairCapacity());
}

/// Device bytes of the response before it has grown.
inline std::size_t predictedResponseBytes(const SimulatorSettings& s) {
    if (s.response != ResponseMethod::massSplit) return 0;
    return ImpulseResponse::predictedBytes(static_cast<std::size_t>(s.objects),
                                           s.firstPairCapacity());
}

}  // namespace ballpit
