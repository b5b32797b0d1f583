// The summary's two forms.
#include "common/summary.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace ballpit {

namespace {

void line(const char* what, const std::string& value) {
    std::printf("  %-22s%s\n", what, value.c_str());
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
    char text[160];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

void printText(const Summary& s) {
    const Metrics& m = s.metrics;
    std::printf("%s: %zu balls, %d frames of %.4g ms on %s (%s)\n", s.scene.c_str(), s.balls,
                s.steps, 1e3 * s.dt, name(s.device), describe(s.device).c_str());
    if (s.steps < s.stepsAsked)
        line("stopped early", format("after %d of %d frames", s.steps, s.stepsAsked));
    line(s.readings ? "plan" : "settings", s.plan);
    if (s.readings)
        line("planning", format("%d times, %.2g %% of the time", s.readings, 100 * s.planShare));
    line("time per frame", format("%.3f ms", s.millisecondsPerStep));
    line("contacts now",
         format("%zu (%zu touching pairs handled in all)", m.contacts, s.collisions));
    line("kinetic energy", format("%.6g J", m.kineticEnergy));
    line("potential energy", format("%.6g J", m.potentialEnergy));
    line("momentum", format("%.4g kg m/s (%.4g, %.4g, %.4g)", length(m.momentum), m.momentum.x,
                            m.momentum.y, m.momentum.z));
    line("largest penetration", format("%.4g m", m.largestPenetration));
    line("bodies lost", format("%zu", m.lost));
    if (m.notFinite) line("bodies not finite", format("%zu", m.notFinite));
    line("grid built twice", format("in %zu steps", s.rebuilds));
    if (s.overflows) line("pair list grown", format("%zu times, nothing dropped", s.overflows));
    if (s.outside) line("outside when hashed", format("%zu times (clamped)", s.outside));
    line("state hash", hashText(s.hash));
    for (const auto& [what, file] :
         {std::pair{"video", s.video}, {"picture", s.picture}, {"final state", s.save}})
        if (!file.empty()) line(what, file);
}

nlohmann::json vectorJson(Vec3d v) { return {v.x, v.y, v.z}; }

void printJson(const Summary& s) {
    const Metrics& m = s.metrics;
    const nlohmann::ordered_json json{{"scene", s.scene},
                                      {"device", name(s.device)},
                                      {"machine", describe(s.device)},
                                      {"balls", s.balls},
                                      {"steps", s.steps},
                                      {"steps_asked", s.stepsAsked},
                                      {"dt_s", s.dt},
                                      {"ms_per_step", s.millisecondsPerStep},
                                      {"plan", s.plan},
                                      {"plan_readings", s.readings},
                                      {"plan_share", s.planShare},
                                      {"contacts", m.contacts},
                                      {"collisions", s.collisions},
                                      {"kinetic_energy_J", m.kineticEnergy},
                                      {"potential_energy_J", m.potentialEnergy},
                                      {"shadow_energy_J", m.shadowEnergy},
                                      {"momentum_kg_m_s", vectorJson(m.momentum)},
                                      {"angular_momentum_kg_m2_s", vectorJson(m.angularMomentum)},
                                      {"largest_penetration_m", m.largestPenetration},
                                      {"mean_penetration_m", m.meanPenetration},
                                      {"lost", m.lost},
                                      {"not_finite", m.notFinite},
                                      {"overflows", s.overflows},
                                      {"rebuilds", s.rebuilds},
                                      {"outside", s.outside},
                                      {"state_hash", hashText(s.hash)},
                                      {"video", s.video},
                                      {"picture", s.picture},
                                      {"save", s.save}};
    std::printf("%s\n", json.dump().c_str());
}

}  // namespace

void printSummary(const Summary& summary, bool json) {
    json ? printJson(summary) : printText(summary);
}

}  // namespace ballpit
