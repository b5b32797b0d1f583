// Chapter 12: one decision of the plan, which all others of its kind are made with: into how many
// parts something is cut, so that no part is too large. A frame into steps, by how far the fastest
// ball flies; a step into substeps, by how deep the balls at the bottom sink.
#pragma once

#include <algorithm>
#include <cmath>

//@starter #include "common/hole.cuh"

namespace ballpit {

/// The smallest whole number of parts, at least 1 and at most `most`, in which `whole` is at most
/// `limit` each; `most` if the limit is 0. If there are `now` parts already (0: none yet), they
/// stay, unless that is too few or less than half would do: a scene on a threshold shall not go to
/// and fro.
inline int partsFor(double whole, double limit, int most, int now) {
    //@hole plan.parts lines=3 "Whole over limit, rounded up, 1 to most; do those of now stay?"
    //@starter TODO_HOLE("plan.parts");
    //@starter return 1;
    const double exact = limit > 0 ? whole / limit : most;
    const int wanted = static_cast<int>(std::clamp(std::ceil(exact - 1e-9), 1.0, double(most)));
    return now > 0 && wanted <= now && 2 * wanted > now ? now : wanted;
    //@end
}

/// How many substeps, if one a frame ends with an overlap of `overlapOfOne` radii and `tolerance`
/// is allowed? n substeps leave 1/n^2 of it: each falls for 1/n of the time, with 1/n of the speed.
inline int substepsFor(double overlapOfOne, double tolerance, int most, int now) {
    //@hole plan.substeps lines=1 "The overlap falls with the square: what is to be cut into parts?"
    //@starter TODO_HOLE("plan.substeps");
    //@starter return 1;
    return partsFor(std::sqrt(overlapOfOne), std::sqrt(tolerance), most, now);
    //@end
}

}  // namespace ballpit
