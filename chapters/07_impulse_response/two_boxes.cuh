// The chapter's film: the same shot into a triangle of balls, in two boxes. On the left every ball
// adds up the impulses of its contacts as they are; on the right the masses are split.
#pragma once

#include <memory>
#include <vector>

#include "07_impulse_response/atomic_response.cuh"
#include "07_impulse_response/impulse_response.cuh"
#include "common/coloring.h"
#include "common/film.h"
#include "common/host_pairs.h"
#include "common/motion.h"
#include "common/one_round.cuh"

namespace ballpit {

/// Elastic balls in a box without gravity. Pairs are searched on the host: this chapter's film
/// needs no grid.
class Box {
public:
    Box(const Options& options, std::unique_ptr<Response> response)
        : device_(options.device),
          scene_(makeScene("break", 16, options.seed)),
          response_(std::move(response)) {}

    void step() {
        const Vec3 margin{0.5f, 0.5f, 0.5f};
        drift(scene_.spheres, {scene_.bounds.lower + margin, scene_.bounds.upper - margin});
        const std::vector<Pair> pairs = findPairsOnHost(scene_.spheres);
        scene_.spheres = OneRound(device_, scene_.spheres, pairs).resolve(*response_);
    }

    /// Adds the balls, coloured by speed: yellow is as fast as the shot was, or faster.
    void addTo(Spheres& all, Vec3 shift) const {
        const auto colors =
            colorsBy(ColorBy::speed, {.balls = scene_.spheres, .topSpeed = shotSpeed});
        for (std::size_t k = 0; k < scene_.spheres.count(); ++k)
            all.add(scene_.spheres.positions[k] + shift, {}, 0.5f, 1.0f, 1.0f, colors[k]);
    }

    Bounds bounds() const { return scene_.bounds; }

private:
    static constexpr float shotSpeed = 6.0f;

    Device device_;
    Scene scene_;
    std::unique_ptr<Response> response_;
};

inline void showTwoBoxes(const Options& options) {
    constexpr int ballCount = 16, pairsAtMost = ballCount * (ballCount - 1) / 2;
    Box plain(options, std::make_unique<AtomicResponse>(options.device));
    Box split(options, std::make_unique<ImpulseResponse>(options.device, ballCount, pairsAtMost));
    const Bounds box = plain.bounds();
    const Vec3 shift{box.upper.x, 0, 0};
    showMotion(options, {box.lower - shift, box.upper + shift}, {}, [&](Spheres& all, float share) {
        if (share > 0) plain.step(), split.step();
        all = {};
        plain.addTo(all, -shift);
        split.addTo(all, shift);
        constexpr float fence = 0.15f;
        for (float z = box.lower.z; z < box.upper.z; z += 2 * fence)
            all.add({0, fence, z}, {}, fence, 1.0f, 1.0f, {0.2f, 0.22f, 0.28f});
    });
}

}  // namespace ballpit
