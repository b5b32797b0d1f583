// What makes a body's values unusable, in words.
#include "common/spheres.h"

#include <cmath>
#include <sstream>

namespace ballpit {

namespace {

template <class... Parts>
std::string text(const Parts&... parts) {
    std::ostringstream stream;
    (stream << ... << parts);
    return stream.str();
}

std::string faultOfVector(const char* what, const char* unit, Vec3 v) {
    if (isFinite(v)) return "";
    return text(what, " (", v.x, ", ", v.y, ", ", v.z, "): must be finite numbers in ", unit);
}

}  // namespace

std::string faultOfPosition(Vec3 value) { return faultOfVector("position", "m", value); }
std::string faultOfVelocity(Vec3 value) { return faultOfVector("velocity", "m/s", value); }

std::string faultOfRadius(float value) {
    if (std::isfinite(value) && value >= 0.0f) return "";
    return text("radius ", value, ": must be a finite number of metres, 0 or more");
}

std::string faultOfMass(float value) {
    if (std::isfinite(value) && value > 0.0f && std::isfinite(1.0f / value)) return "";
    return text("mass ", value, ": must be a finite number of kilograms above 0");
}

std::string faultOfRestitution(float value) {
    if (value >= 0.0f && value <= 1.0f) return "";
    return text("restitution ", value, ": must lie between 0 (dead stop) and 1 (elastic)");
}

Vec3 paletteColor(std::size_t k) {
    static constexpr Vec3 palette[] = {
        {0.90f, 0.30f, 0.24f}, {0.95f, 0.61f, 0.07f}, {0.95f, 0.80f, 0.25f}, {0.25f, 0.72f, 0.45f},
        {0.15f, 0.68f, 0.70f}, {0.24f, 0.52f, 0.86f}, {0.58f, 0.40f, 0.80f}, {0.88f, 0.45f, 0.65f}};
    return palette[k % std::size(palette)];
}

}  // namespace ballpit
