// Runs charts: chooses points, takes up what an earlier run has, measures the rest, writes files.
#include "chart/run_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>

#include "chart/working_file.h"
#include "common/error.h"
#include "common/progress.h"
#include "common/timing.h"
#include "common/whole_file.h"
#include "common/words.h"

namespace ballpit::chart {

namespace {

using stability::Question;

constexpr int stoppedByUser = 130;
constexpr const char* quickScenes[] = {"bounce", "elastic_gas", "six_cubed", "column",
                                       "heavy_on_light"};

struct Point {
    const Question* question;
    Runner* runner;
    Setting setting;
    double expected = 0;  ///< s
};

std::vector<const Question*> questionsOf(const Asked& asked) {
    std::vector<const Question*> chosen;
    std::vector<std::string> names = asked.scenes;
    if (names.empty() && asked.sweep.quick)
        names.assign(std::begin(quickScenes), std::end(quickScenes));
    for (const std::string& name : names) {
        const Question* found = &stability::question(name);
        if (std::find(chosen.begin(), chosen.end(), found) == chosen.end()) chosen.push_back(found);
    }
    if (names.empty())
        for (const Question& question : stability::questions()) chosen.push_back(&question);
    return chosen;
}

std::string namesOf(const Runners& runners) {
    return commaSeparated(runners, [](const auto& runner) { return runner->method(); });
}

/// Of these runners the ones that were asked for: all, if none.
std::vector<Runner*> runnersOf(const Asked& asked, const Runners& all) {
    std::vector<Runner*> chosen;
    for (const std::string& wanted : asked.methods) {
        const auto found = std::find_if(
            all.begin(), all.end(), [&](const auto& runner) { return runner->method() == wanted; });
        if (found == all.end())
            throw InputError("method '" + wanted + "': known methods are " + namesOf(all) +
                             (asked.peers ? "" : "; other engines' need --peers"));
        chosen.push_back(found->get());
    }
    if (chosen.empty())
        for (const auto& runner : all) chosen.push_back(runner.get());
    return chosen;
}

Runners allRunners(const Asked& asked) {
    Runners runners = ourRunners(asked.device);
    if (!asked.peers) return runners;
    Peers peers = peerRunners();
    for (const std::string& line : peers.missing) std::fprintf(stderr, "note: %s\n", line.c_str());
    for (auto& runner : peers.runners) runners.push_back(std::move(runner));
    return runners;
}

/// The one setting of --steps and --passes, or all that are worth trying.
std::vector<Setting> settingsOf(const Runner& runner, const Asked& asked) {
    if (!asked.steps && !asked.passes) return settingsToTry(runner, asked.sweep.quick);
    Knobs knobs = runner.usual();
    knobs.stepsAFrame = asked.steps.value_or(knobs.stepsAFrame);
    if (asked.passes && runner.passesName().empty())
        throw InputError("--passes: the method " + runner.method() + " has none");
    knobs.passes = asked.passes.value_or(knobs.passes);
    return {{knobs, "both"}};
}

std::vector<Point> pointsOf(const Asked& asked, const std::vector<Runner*>& runners) {
    std::vector<Point> points;
    for (const Question* question : questionsOf(asked))
        for (Runner* runner : runners) {
            if (!runner->canRun(*question)) continue;
            for (const Setting& setting : settingsOf(*runner, asked))
                points.push_back({question, runner, setting});
        }
    return points;
}

/// What all rows of a run depend on, as comments.
std::string headOf(const Asked& asked) {
    return asComments(asked.stamp) + "# seed " + std::to_string(asked.sweep.seed) + ", " +
           name(asked.device) + (asked.sweep.quick ? ", quick" : "") + '\n';
}

/// Fills in what each point will take; s, of all that are not there yet.
double expectAll(std::vector<Point>& points, const WorkingFile& file, const Sweep& sweep) {
    double sum = 0, millisecondsASecond = 0;
    const Point* probed = nullptr;
    for (Point& point : points) {
        if (file.find(emptyRow(*point.question, *point.runner, point.setting, sweep))) continue;
        if (!probed || probed->question != point.question || probed->runner != point.runner)
            millisecondsASecond = probe(*point.question, *point.runner, sweep);
        probed = &point;
        point.expected = expectedSeconds(*point.question, *point.runner, point.setting, sweep,
                                         millisecondsASecond);
        sum += point.expected;
    }
    return sum;
}

/// Says how far it is: at most every two seconds, and at the end of each scene.
class PointCounter {
public:
    PointCounter(std::size_t points, double expected) : points_(points), left_(expected) {}
    void done(const Point& point, bool endsScene) {
        ++done_;
        left_ -= point.expected;
        const double now = 1e-3 * milliseconds();
        if (!endsScene && now - shown_ < 2) return;
        shown_ = now;
        const double spent = now - start_, expectedSoFar = total_ - left_;
        const double pace = expectedSoFar > 0 ? spent / expectedSoFar : 1;
        std::fprintf(stderr, "%s: %zu of %zu points, %.0f s, about %.0f s left\n",
                     point.question->scene, done_, points_, spent, std::max(0.0, left_ * pace));
    }

private:
    std::size_t points_, done_ = 0;
    double left_, total_ = left_, start_ = 1e-3 * milliseconds(), shown_ = start_;
};

int printQuestions() {
    std::printf("| scene | error | error 0 | tolerance | simulated |\n|---|---|---|---|---|\n");
    for (const Question& q : stability::questions())
        std::printf("| `%s` | %s | %s | %g | %.3g s |\n", q.scene, q.error, q.heldAgainst,
                    q.tolerance, q.seconds);
    return exitOk;
}

void print(const Row& row) {
    std::printf("%s, %s, %s\n", row.scene.c_str(), row.method.c_str(), row.label.c_str());
    std::printf("  verdict            %s\n  error              %.6g (tolerance %g)\n",
                row.verdict.c_str(), row.error, row.tolerance);
    if (row.runs > 0)
        std::printf(
            "  real-time factor   %.4g\n  ms a second        %.4g (%.4g to %.4g, %d runs)\n",
            row.realTimeFactor(), row.milliseconds.median, row.milliseconds.low,
            row.milliseconds.high, row.runs);
    std::printf("  pair visits a second  %.6g\n", row.pairVisits);
}

int printPoints(const std::vector<Point>& points, const Sweep& sweep) {
    for (const Point& point : points) {
        const auto row = measuredRow(*point.question, *point.runner, point.setting, sweep);
        if (!row) return stoppedByUser;
        print(*row);
    }
    return exitOk;
}

int writeCharts(const Asked& asked, std::vector<Point> points) {
    const std::string head = headOf(asked);
    WorkingFile file(asked.out + "/chart.part", head);
    if (file.replacedAnother())
        std::fprintf(stderr, "begins anew: what was left in %s/chart.part is of another run\n",
                     asked.out.c_str());
    if (!file.rows().empty())
        std::fprintf(stderr, "goes on: %zu points are there\n", file.rows().size());
    const double expected = expectAll(points, file, asked.sweep);
    std::fprintf(stderr, "%zu points, about %.0f s on an idle machine\n", points.size(),
                 std::ceil(expected));
    PointCounter counter(points.size(), expected);
    std::vector<Row> rows;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Point& point = points[k];
        const Question& question = *point.question;
        if (!file.find(emptyRow(question, *point.runner, point.setting, asked.sweep))) {
            const auto row = measuredRow(question, *point.runner, point.setting, asked.sweep);
            if (!row) return stoppedByUser;
            file.append(*row);
        }
        rows.push_back(*file.find(emptyRow(question, *point.runner, point.setting, asked.sweep)));
        const bool endsScene = k + 1 == points.size() || points[k + 1].question != &question;
        counter.done(point, endsScene);
        if (!endsScene) continue;
        const std::string path = asked.out + "/chart_" + question.scene + ".csv";
        writeWhole(path, chartText(question, head, rows));
        std::cout << path << std::endl;
        rows.clear();
    }
    file.remove();
    return exitOk;
}

}  // namespace

std::string chartText(const Question& question, const std::string& head, std::vector<Row> rows) {
    markFronts(rows);
    std::ostringstream text;
    text << "# chart: " << question.scene << "\n# error: " << question.error
         << "\n# held against: " << question.heldAgainst << "\n# tolerance: " << question.tolerance
         << "\n# simulated: " << question.seconds
         << " s\n# balls: " << question.make(1).spheres.count() << '\n'
         << head << rowHeader << '\n';
    for (const Row& row : rows) text << lineOf(row) << '\n';
    return text.str();
}

int runChart(const Asked& given) {
    Asked asked = given;
    if (asked.printQuestions) return printQuestions();
    requireUsable(asked.device);
    requireOutFolder(asked.out);
    if (asked.sweep.quick) asked.sweep.runs = 3;
    if (asked.device == Device::cuda) asked.sweep.further += " --device cuda";
    if (asked.sweep.seed != 1) asked.sweep.further += " --seed " + std::to_string(asked.sweep.seed);
    if (asked.peers) asked.sweep.further += " --peers";
    const Runners runners = allRunners(asked);
    const std::vector<Point> points = pointsOf(asked, runnersOf(asked, runners));
    if (points.empty()) throw InputError("none of these methods can run any of these scenes");
    const StopRequest stop;
    if (asked.steps || asked.passes) return printPoints(points, asked.sweep);
    return writeCharts(asked, points);
}

}  // namespace ballpit::chart
