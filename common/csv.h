// Bodies as text: one line a ball, so that a scene can be made in a spreadsheet.
#pragma once

#include <string>

#include "common/spheres.h"

namespace ballpit {

/// Reads `x,y,z,vx,vy,vz,radius,mass,restitution[,red,green,blue]` lines after a header line.
/// InputError naming file, line and what would be right.
Spheres readSpheres(const std::string& path);

/// Writes what readSpheres reads, with enough digits to give the same bits back. The file appears
/// under its name only when it is complete.
void writeSpheres(const std::string& path, const Spheres& spheres);

}  // namespace ballpit
