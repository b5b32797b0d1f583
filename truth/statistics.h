// Does a sample come from a distribution? The test of Kolmogorov and Smirnov, and moments.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ballpit::truth {

/// The largest distance between the sample's share below v and `shareBelow(v)`.
template <class ShareBelow>
double kolmogorovDistance(std::vector<double> sample, ShareBelow shareBelow) {
    std::sort(sample.begin(), sample.end());
    const double count = static_cast<double>(sample.size());
    double distance = 0;
    for (std::size_t k = 0; k < sample.size(); ++k) {
        const double share = shareBelow(sample[k]), below = static_cast<double>(k) / count;
        distance = std::max({distance, share - below, below + 1 / count - share});
    }
    return distance;
}

/// How often chance alone gives at least this distance: 2 sum (-1)^(k-1) exp(-2 k^2 x^2), with
/// x = (sqrt(n) + 0.12 + 0.11 / sqrt(n)) distance (Stephens 1970).
inline double kolmogorovProbability(double distance, std::size_t sampleSize) {
    const double root = std::sqrt(static_cast<double>(sampleSize));
    const double x = (root + 0.12 + 0.11 / root) * distance;
    if (x < 0.2) return 1;  // the sum below converges slowly there
    double sum = 0;
    for (int k = 1; k <= 100; ++k) sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2 * k * k * x * x);
    return std::clamp(sum, 0.0, 1.0);
}

/// <v^power>.
inline double moment(const std::vector<double>& sample, int power) {
    double sum = 0;
    for (const double v : sample) sum += std::pow(v, power);
    return sum / static_cast<double>(sample.size());
}

}  // namespace ballpit::truth
