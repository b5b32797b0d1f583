// A finished map as CSV, whole or not at all.
#pragma once

#include <string>
#include <vector>

#include "stability/map.h"

namespace ballpit::stability {

/// Comments: what it is, and `stamp` (machine, commit, command), line by line. Then rows
///     axes,PANEL,x label,y label,,,
///     cell,PANEL,x,y,verdict,value,
///     line,PANEL,x,y,,,label
/// `outcomes`: of each panel, row by row. InputError if the folder cannot be written.
void writeMap(const std::string& path, const Map& map,
              const std::vector<std::vector<Outcome>>& outcomes, const std::string& stamp);

}  // namespace ballpit::stability
