// Rows as text, and which of them are on the front.
#include "chart/row.h"

#include <cstdlib>

#include "12_speed_and_accuracy/pareto_front.h"
#include "common/words.h"

namespace ballpit::chart {

const char* const rowHeader =
    "scene,engine,method,curve,steps_a_frame,dt,passes,passes_name,label,error,tolerance,verdict,"
    "ms_a_second,ms_low,ms_high,real_time_factor,pair_visits_a_second,runs,on_front,"
    "on_front_of_visits,command";

namespace {

constexpr std::size_t fieldCount = 21;

/// Quoted where it must be.
std::string field(const std::string& text) {
    return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

}  // namespace

std::string lineOf(const Row& r) {
    const std::string fields[] = {r.scene,
                                  r.engine,
                                  r.method,
                                  r.curve,
                                  withDigits(r.knobs.stepsAFrame),
                                  withDigits(r.dt),
                                  std::to_string(r.knobs.passes),
                                  r.passesName,
                                  r.label,
                                  withDigits(r.error),
                                  withDigits(r.tolerance),
                                  r.verdict,
                                  withDigits(r.milliseconds.median),
                                  withDigits(r.milliseconds.low),
                                  withDigits(r.milliseconds.high),
                                  withDigits(r.realTimeFactor()),
                                  withDigits(r.pairVisits),
                                  std::to_string(r.runs),
                                  r.onFront ? "yes" : "no",
                                  r.onFrontOfVisits ? "yes" : "no",
                                  r.command};
    static_assert(std::size(fields) == fieldCount);
    std::string line;
    for (const std::string& text : fields) line += (line.empty() ? "" : ",") + field(text);
    return line;
}

std::optional<Row> rowOf(const std::string& line) {
    const std::vector<std::string> f = fieldsOf(line);
    if (f.size() != fieldCount) return std::nullopt;
    const auto value = [&](std::size_t k) { return std::strtod(f[k].c_str(), nullptr); };
    const auto whole = [&](std::size_t k) { return std::atoi(f[k].c_str()); };
    return Row{.scene = f[0],
               .engine = f[1],
               .method = f[2],
               .curve = f[3],
               .knobs = {value(4), whole(6)},
               .dt = value(5),
               .passesName = f[7],
               .label = f[8],
               .error = value(9),
               .tolerance = value(10),
               .verdict = f[11],
               .milliseconds = {value(12), value(13), value(14)},
               .pairVisits = value(16),
               .runs = whole(17),
               .onFront = f[18] == "yes",
               .onFrontOfVisits = f[19] == "yes",
               .command = f[20]};
}

void markFronts(std::vector<Row>& rows) {
    std::vector<WorkPoint> timed, counted;
    for (const Row& row : rows) {
        timed.push_back({row.realTimeFactor(), row.error, !row.isGood()});
        // A run without a single pair to visit shows nothing about the work of a method.
        counted.push_back({1 / row.pairVisits, row.error, !row.isGood() || !(row.pairVisits > 0)});
    }
    const std::vector<bool> front = paretoFront(timed), frontOfVisits = paretoFront(counted);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        rows[k].onFront = front[k];
        rows[k].onFrontOfVisits = frontOfVisits[k];
    }
}

}  // namespace ballpit::chart
