// Chapter 12: how exactly a scene wants its answer.
#pragma once

#include <string>

namespace ballpit {

/// The tolerance of the scene of that name as a share (an angle: in radians): the catalogue's, or
/// plan.h's usual one where it says none or 0.
double toleranceOf(const std::string& scene);

}  // namespace ballpit
