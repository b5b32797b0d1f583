// A small random generator whose numbers are the same with every compiler and library.
#pragma once

#include <cstdint>

#include "common/vec3.cuh"

namespace ballpit {

/// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
        z = (z ^ z >> 27) * 0x94D049BB133111EBu;
        return z ^ z >> 31;
    }

    /// Uniform in [low, high): 24 random bits, as many as a float holds.
    float uniform(float low, float high) {
        return low + (high - low) * (static_cast<float>(next() >> 40) * 0x1p-24f);
    }

    Vec3 uniformIn(Bounds box) {
        const float x = uniform(box.lower.x, box.upper.x);
        const float y = uniform(box.lower.y, box.upper.y);
        const float z = uniform(box.lower.z, box.upper.z);
        return {x, y, z};
    }

private:
    std::uint64_t state_;
};

}  // namespace ballpit
