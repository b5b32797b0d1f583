// Chapter 12: a plan as text for people and as JSON.
#pragma once

#include <string>

#include "12_speed_and_accuracy/plan.h"

namespace ballpit {

/// What was chosen, one line a choice. With `explain`, why, and what was left out, below each.
std::string planText(const std::string& scene, const SceneFacts& facts, const World& world,
                     const Plan& plan, bool explain);

std::string planJson(const std::string& scene, const SceneFacts& facts, const World& world,
                     const Plan& plan);

}  // namespace ballpit
