// Chapter 12: looks tolerances up.
#include "12_speed_and_accuracy/tolerance.h"

#include <numbers>

#include "12_speed_and_accuracy/plan.h"
#include "stability/catalogue.h"

namespace ballpit {

double toleranceOf(const std::string& scene) {
    for (const stability::Entry& entry : stability::catalogue()) {
        if (scene != entry.name || entry.within <= 0) continue;
        const bool isAngle = std::string(entry.tolerance).find("degrees") != std::string::npos;
        return isAngle ? entry.within * std::numbers::pi / 180 : entry.within;
    }
    return usualTolerance;
}

}  // namespace ballpit
