// Chapter 12: writes a plan down.
#include "12_speed_and_accuracy/plan_text.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace ballpit {

namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
    char text[240];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

constexpr std::size_t textWidth = 100;

/// `text` after `head`, broken into lines; all but the first are indented as far as the head.
std::string wrapped(const std::string& head, const std::string& text) {
    std::string lines, line = head;
    bool empty = true;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        begin = end + 1;
        if (!empty && line.size() + 1 + word.size() > textWidth) {
            lines += line + '\n';
            line = std::string(head.size(), ' ');
            empty = true;
        }
        line += (empty ? "" : " ") + word;
        empty = false;
    }
    return lines + line + '\n';
}

/// From a quarter of the facts' numbers to the whole picture: what the choices look at.
std::string factsText(const SceneFacts& f, const World& w) {
    std::string text;
    text += format("  radii                %.4g to %.4g m\n", double(f.smallestRadius),
                   double(f.largestRadius));
    text += format("  masses               %.4g to %.4g kg, of two that touch up to %.3g fold\n",
                   double(f.smallestMass), double(f.largestMass), double(f.massRatio));
    text += format("  restitution          %.3g to %.3g\n", double(f.smallestRestitution),
                   double(f.largestRestitution));
    text +=
        format("  speed                up to %.4g m/s (rms %.4g), %.3g r a frame; to come %.4g\n",
               double(f.largestSpeed), double(f.rmsSpeed),
               double(f.largestSpeed) * w.frame / f.smallestRadius, double(f.speedToCome));
    text += format("  gravity              %.4g m/s^2\n", double(length(w.gravity)));
    text += format("  volume share         %.3g where the balls are\n", volumeShare(f, w));
    text += format("  depth                %.3g balls, a load of %.3g on the lowest\n",
                   depthInBalls(f, w), loadOnLightest(f, w));
    text += format("  touching now         %u pairs, up to %u of a ball, %.3g r deep\n", f.pairs,
                   f.mostContacts, double(f.deepestOverlap));
    text += format("  a step at the start  %.3g floats long, %.4g m from the origin\n",
                   floatsPerStep(f, w, w.frame), farthestCoordinate(w));
    return text;
}

std::string choiceText(const Choice& choice, bool explain) {
    std::string text = format("  %-21s%s\n", choice.what.c_str(), choice.value.c_str());
    if (!explain) return text;
    text += wrapped("      because   ", choice.because);
    if (!choice.leftOut.empty()) text += wrapped("      left out  ", choice.leftOut);
    return text;
}

}  // namespace

std::string planText(const std::string& scene, const SceneFacts& facts, const World& world,
                     const Plan& plan, bool explain) {
    std::string text = format("%s: %d balls, frames of %.4g ms\n", scene.c_str(), facts.count,
                              1e3 * double(world.frame));
    if (explain) text += "facts\n" + factsText(facts, world);
    text += format("plan for an error of at most %.3g: ", plan.tolerance) + name(plan.aim) + "\n";
    for (const Choice& choice : plan.choices) text += choiceText(choice, explain);
    text += format("  predicted error      %.2g\n", plan.predictedError);
    text += format("  predicted cost       %.3g pair visits, about %.2g ms a simulated second\n",
                   plan.pairVisits, plan.milliseconds);
    for (const std::string& warning : plan.warnings) text += wrapped("  warning: ", warning);
    return text;
}

std::string planJson(const std::string& scene, const SceneFacts& f, const World& w,
                     const Plan& plan) {
    nlohmann::ordered_json choices = nlohmann::ordered_json::array();
    for (const Choice& c : plan.choices)
        choices.push_back({{"what", c.what},
                           {"value", c.value},
                           {"because", c.because},
                           {"left_out", c.leftOut}});
    const nlohmann::ordered_json json{{"scene", scene},
                                      {"balls", f.count},
                                      {"aim", name(plan.aim)},
                                      {"tolerance", plan.tolerance},
                                      {"in_short", inShort(plan)},
                                      {"choices", choices},
                                      {"predicted_error", plan.predictedError},
                                      {"pair_visits_a_second", plan.pairVisits},
                                      {"ms_a_second", plan.milliseconds},
                                      {"volume_share", volumeShare(f, w)},
                                      {"depth_in_balls", depthInBalls(f, w)},
                                      {"load", loadOnLightest(f, w)},
                                      {"warnings", plan.warnings}};
    return json.dump() + "\n";
}

}  // namespace ballpit
