// Chapter 12: one decision of the plan, which all others of its kind are made with: into how many
// parts something is cut, so that no part is too large. A frame into steps, by how far the fastest
// ball flies; a step into substeps, by how deep the balls at the bottom sink.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/hole.cuh"

namespace ballpit {

/// The smallest whole number of parts, at least 1 and at most `most`, in which `whole` is at most
/// `limit` each; `most` if the limit is 0. If there are `now` parts already (0: none yet), they
/// stay, unless that is too few or less than half would do: a scene on a threshold shall not go to
/// and fro.
inline int partsFor(double whole, double limit, int most, int now) {
    // ---- hole plan.parts (about 3 lines): Whole over limit, rounded up, 1 to most; do those of now stay?
    TODO_HOLE("plan.parts");
    return 1;
    // ---- end of plan.parts
}

/// How many substeps, if one a frame ends with an overlap of `overlapOfOne` radii and `tolerance`
/// is allowed? n substeps leave 1/n^2 of it: each falls for 1/n of the time, with 1/n of the speed.
inline int substepsFor(double overlapOfOne, double tolerance, int most, int now) {
    // ---- hole plan.substeps (about 1 line): The overlap falls with the square: what is to be cut into parts?
    TODO_HOLE("plan.substeps");
    return 1;
    // ---- end of plan.substeps
}

}  // namespace ballpit
