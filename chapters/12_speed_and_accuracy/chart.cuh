// What the chapter's program tells: where the original loop and the plan lie in some scenes, and
// which of some more loops are on a scene's front.
#pragma once

#include <algorithm>
#include <cstdio>
#include <vector>

#include "chapters/12_speed_and_accuracy/answer.cuh"
#include "chapters/12_speed_and_accuracy/example.h"
#include "common/findings.h"

namespace ballpit {

using Questions = std::vector<const stability::Question*>;

/// "few", "every", or one scene's name. InputError for an unknown name, with the known ones.
inline Questions questionsNamed(const std::string& name) {
    using stability::question;
    if (name == "few")
        return {&question("six_cubed"), &question("elastic_gas"), &question("mixed_radii")};
    if (name != "every") return {&question(name)};
    Questions all;
    for (const stability::Question& each : stability::questions()) all.push_back(&each);
    return all;
}

/// What --scene can be.
inline std::string questionChoice() {
    return "few (three of them), every, or one of " + stability::questionNames();
}

/// Loops to compare: the original one, also with more steps a frame; other methods; the plan.
inline std::vector<Loop> sweep() {
    using enum ResponseMethod;
    std::vector<Loop> loops{originalLoop(),
                            {"original loop, 4 steps a frame", massSplit, 2, 4},
                            {"original loop, 16 steps a frame", massSplit, 2, 16}};
    for (const int passes : {2, 8})
        loops.push_back({"coloured, " + std::to_string(passes) + " passes", coloured, passes});
    for (const int passes : {4, 16})
        loops.push_back({"warm, " + std::to_string(passes) + " passes", warm, passes});
    for (const int substeps : {1, 2, 4, 8, 16})
        loops.push_back({"small-steps, " + std::to_string(substeps) +
                             (substeps == 1 ? " substep" : " substeps"),
                         smallSteps, substeps});
    loops.push_back(plannedLoop());
    return loops;
}

inline std::string inWords(const Answer& answer) {
    char words[120];
    std::snprintf(words, sizeof words, "error %.3g, %.4g visits a second", answer.error,
                  answer.visits);
    return answer.hasFailed()
               ? std::string("no answer: ") + name(answer.verdict) + " (" + words + ")"
               : words;
}

/// Pair visits, error and tolerance, and whether it failed, for figures.
inline std::vector<double> inNumbers(const Answer& answer, const stability::Question& question) {
    return {answer.visits, answer.error, question.tolerance, answer.hasFailed() ? 1.0 : 0.0};
}

/// The original loop and the plan.
inline void tellBoth(Findings& findings, const stability::Question& question,
                     const Options& options) {
    const std::string scene = question.scene;
    char words[120];
    std::snprintf(words, sizeof words, "%s, %.3g at most", question.error, question.tolerance);
    findings.add(scene + " asks for", std::string(words));
    for (const Loop& loop : {originalLoop(), plannedLoop()}) {
        const Answer answer = answerOf(question, loop, options);
        const std::string who = scene + ", " + loop.name;
        findings.add(who, inWords(answer));
        findings.list(who + ", numbers", inNumbers(answer, question));
        if (!loop.method) findings.add(who + " chose", answer.settings);
        findings.add(who + ", state hash", answer.hash);
    }
}

/// ": on the front", ": beaten by 3"; nothing for who has failed.
inline std::string standing(const std::vector<WorkPoint>& points, std::size_t k, bool isOnFront) {
    if (points[k].failed) return "";
    if (isOnFront) return ": on the front";
    const auto better = std::count_if(points.begin(), points.end(), [&](const WorkPoint& other) {
        return hasResult(other) && dominates(other, points[k]);
    });
    return ": beaten by " + std::to_string(better);
}

/// All loops of the sweep in one scene, and which of them are on the front.
inline void tellFront(Findings& findings, const stability::Question& question,
                      const Options& options) {
    const std::vector<Loop> loops = sweep();
    std::vector<Answer> answers;
    std::vector<WorkPoint> points;
    for (const Loop& loop : loops) {
        answers.push_back(answerOf(question, loop, options));
        points.push_back(answers.back().point());
    }
    const std::vector<bool> front = paretoFront(points);
    for (std::size_t k = 0; k < loops.size(); ++k) {
        const std::string who = std::string(question.scene) + ": " + loops[k].name;
        findings.add(who, inWords(answers[k]) + standing(points, k, front[k]));
        std::vector<double> numbers = inNumbers(answers[k], question);
        numbers.push_back(front[k] ? 1 : 0);
        findings.list(who + ", numbers", numbers);
    }
}

/// The lesson's eight points, for its figure.
inline void tellExample(Findings& findings) {
    std::vector<WorkPoint> points;
    std::vector<double> speeds, errors, failed, onFront;
    for (const ExamplePoint& point : examplePoints()) {
        points.push_back(point.work());
        speeds.push_back(point.speed), errors.push_back(point.error);
        failed.push_back(point.failed ? 1 : 0);
    }
    for (const bool isOn : paretoFront(points)) onFront.push_back(isOn ? 1 : 0);
    findings.list("example speeds", speeds);
    findings.list("example errors", errors);
    findings.list("example failed", failed);
    findings.list("example on front", onFront);
}

/// How long a simulated second takes with the original loop and with the plan: the median of some
/// runs of the scenes' first seconds. The plan's time in the first scene stands for the chapter.
inline void tellSpeeds(Findings& findings, Questions questions, const Options& options) {
    constexpr int runs = 3;
    constexpr double seconds = 2;
    if (options.scene == "few") questions.resize(1);
    for (const stability::Question* question : questions)
        for (const Loop& loop : {originalLoop(), plannedLoop()}) {
            std::vector<double> times;
            for (int k = 0; k < runs; ++k)
                times.push_back(Course(*question, loop, options)
                                    .millisecondsASecond(std::min(seconds, question->seconds)));
            std::sort(times.begin(), times.end());
            const double median = times[runs / 2];
            findings.add(std::string(question->scene) + ", " + loop.name +
                             ": milliseconds a simulated second",
                         median);
            if (loop.method || question != questions.front()) continue;
            findings.add("milliseconds", median);
            findings.add("count",
                         static_cast<std::int64_t>(question->make(options.seed).spheres.count()));
        }
}

}  // namespace ballpit
