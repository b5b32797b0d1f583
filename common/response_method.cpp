// One table of the methods and their knobs: names, defaults, what each can be set to.
#include "common/response_method.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "common/error.h"
#include "common/words.h"

namespace ballpit {

namespace {

/// What a knob may be set to; nothing if the method does not have it.
struct Range {
    double least, most;
};

struct Method {
    ResponseMethod method;
    const char* name;
    int iterations, substeps;
    float positionShare;
    float thresholdInFalls;  ///< restitution threshold, in what gravity adds in a substep
    std::optional<Range> iterationRange, substepRange, relaxationRange, thresholdRange, shareRange;
};

constexpr Range rounds{1, 1000}, someOfAll{0.01, 1.0}, anySpeed{0.0, 1e6};

const std::vector<Method>& methods() {
    using enum ResponseMethod;
    constexpr auto none = std::nullopt;
    static const std::vector<Method> table{
        {massSplit, "mass-split", 2, 1, 1, 0, rounds, none, none, none, none},
        {racy, "racy", 2, 1, 1, 0, rounds, none, none, none, none},
        {atomic, "atomic", 2, 1, 1, 0, rounds, none, none, none, none},
        {jacobi, "jacobi", 2, 1, 1, 0, rounds, none, Range{0.01, 2.0}, anySpeed, someOfAll},
        {coloured, "coloured", 2, 1, 1, 0, rounds, none, none, anySpeed, someOfAll},
        {warm, "warm", 8, 1, 0.2f, 2, rounds, none, none, anySpeed, someOfAll},
        {smallSteps, "small-steps", 1, 6, 1, 2, rounds, rounds, none, anySpeed, none},
        {penalty, "penalty", 1, 16, 1, 0, none, rounds, none, none, none}};
    return table;
}

const Method& find(ResponseMethod method) {
    return *std::find_if(methods().begin(), methods().end(),
                         [&](const Method& m) { return m.method == method; });
}

const char* nameOf(const Method& m) { return m.name; }

/// The methods that have a knob, as "jacobi, coloured".
std::string methodsWith(std::optional<Range> Method::*range) {
    std::vector<Method> having;
    std::copy_if(methods().begin(), methods().end(), std::back_inserter(having),
                 [&](const Method& m) { return (m.*range).has_value(); });
    return commaSeparated(having, nameOf);
}

template <class T>
void requireKnob(const Method& m, const char* knob, const std::optional<T>& value,
                 std::optional<Range> Method::*range, const char* unit) {
    if (!value) return;
    const std::string said = std::string(knob) + " " + withDigits(double(*value)) + ": ";
    if (!(m.*range))
        throw InputError(said + "the response " + m.name +
                         " has no such knob; those that have: " + methodsWith(range));
    const Range r = *(m.*range);
    if (!(*value >= r.least && *value <= r.most))
        throw InputError(said + withDigits(r.least) + " to " + withDigits(r.most) + unit);
}

}  // namespace

std::string name(ResponseMethod method) { return find(method).name; }

std::string responseNames() { return commaSeparated(methods(), nameOf); }

ResponseMethod responseMethod(const std::string& name) {
    for (const Method& m : methods())
        if (m.name == name) return m.method;
    throw InputError("response '" + name + "': known responses are " + responseNames());
}

void requireSensible(ResponseMethod method, const ResponseKnobs& knobs) {
    const Method& m = find(method);
    requireKnob(m, "iterations", knobs.iterations, &Method::iterationRange, " rounds a step");
    requireKnob(m, "substeps", knobs.substeps, &Method::substepRange, " a step");
    requireKnob(m, "relaxation", knobs.relaxation, &Method::relaxationRange, "");
    requireKnob(m, "restitution threshold", knobs.restitutionThreshold, &Method::thresholdRange,
                " m/s");
    requireKnob(m, "position share", knobs.positionShare, &Method::shareRange, "");
}

ResponseKnobs completed(ResponseMethod method, ResponseKnobs knobs, float gravity, float dt) {
    const Method& m = find(method);
    knobs.iterations = knobs.iterations.value_or(m.iterations);
    knobs.substeps = knobs.substeps.value_or(m.substeps);
    knobs.relaxation = knobs.relaxation.value_or(1.0f);
    knobs.positionShare = knobs.positionShare.value_or(m.positionShare);
    const float fall = gravity * dt / static_cast<float>(*knobs.substeps);
    knobs.restitutionThreshold = knobs.restitutionThreshold.value_or(m.thresholdInFalls * fall);
    return knobs;
}

}  // namespace ballpit
