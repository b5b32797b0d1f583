// Which response resolves the collisions, and the knobs that it has. What each method does is told
// in its own file, in solutions/07_impulse_response and solutions/11_stability.
#pragma once

#include <optional>
#include <string>

namespace ballpit {

enum class ResponseMethod {
    massSplit,   ///< gathered impulses with split masses, the default
    racy,        ///< the original's in-place kernel: an exhibit, not repeatable
    atomic,      ///< summed by float atomics: an exhibit, repeatable but for rounding
    jacobi,      ///< the plain sum of all impulses, gathered
    coloured,    ///< one after the other, pairs without a common body at the same time
    warm,        ///< accumulated impulses that start from those of the step before
    smallSteps,  ///< many small steps on one list of pairs, velocities from positions
    penalty      ///< springs and dashpots
};

/// A knob left empty has the method's own value; one that the method does not have must be empty.
struct ResponseKnobs {
    std::optional<int> iterations;              ///< rounds, or passes over the contacts, a substep
    std::optional<int> substeps;                ///< how often the bodies move in a step
    std::optional<float> relaxation;            ///< the share of each impulse and push that is used
    std::optional<float> restitutionThreshold;  ///< m/s: slower contacts do not bounce
    std::optional<float> positionShare;         ///< the share of an overlap that a pass takes away
};

/// "small-steps", as on the command line.
std::string name(ResponseMethod method);

/// "mass-split, racy, ...": all names, for messages and --help.
std::string responseNames();

/// InputError for an unknown name, with the known ones.
ResponseMethod responseMethod(const std::string& name);

/// InputError for a knob that the method does not have, or whose value it cannot use: what is
/// wrong, and which methods or values would do.
void requireSensible(ResponseMethod method, const ResponseKnobs& knobs);

/// The knobs with the method's own values where they were empty. `gravity` (m/s^2) and `dt` (s) set
/// the restitution threshold of the methods that have one: what falls for two substeps is at rest.
ResponseKnobs completed(ResponseMethod method, ResponseKnobs knobs, float gravity, float dt);

}  // namespace ballpit
