// Parts of maps.
#include "stability/map.h"

#include <algorithm>
#include <cmath>

namespace ballpit::stability {

const char* name(Verdict verdict) {
    constexpr const char* names[] = {"ok",   "inaccurate", "energy",
                                     "lost", "overflow",   "not finite"};
    return names[static_cast<int>(verdict)];
}

Line lineOver(const Axis& x, const std::string& label, const std::function<double(double)>& f) {
    constexpr int points = 60;
    Line line{label, {}};
    const auto [low, high] = std::minmax_element(x.values.begin(), x.values.end());
    for (int k = 0; k <= points; ++k) {
        const double share = double(k) / points;
        const double at =
            *low > 0 ? *low * std::pow(*high / *low, share) : *low + share * (*high - *low);
        const double y = f(at);
        if (std::isfinite(y)) line.points.emplace_back(at, y);
    }
    return line;
}

Line lineAt(double x, const Axis& y, const std::string& label) {
    const auto [low, high] = std::minmax_element(y.values.begin(), y.values.end());
    return {label, {{x, *low}, {x, *high}}};
}

std::size_t cellCount(const Map& map) {
    std::size_t count = 0;
    for (const Panel& panel : map.panels) count += panel.x.values.size() * panel.y.values.size();
    return count;
}

}  // namespace ballpit::stability
