// ballpit_chart: speed against accuracy, as CSV: chart_SCENE.csv. `./ballpit chart` draws them.
#include "chart/run_chart.h"
#include "common/cli.h"
#include "common/error.h"

using namespace ballpit;
using namespace ballpit::chart;

int main(int argc, char** argv) {
    CLI::App app{
        "Speed against accuracy, for every method and its knobs: CSV files, "
        "chart_SCENE.csv."};
    Asked asked;
    app.add_option(
        "--scene", asked.scenes,
        "scenes to chart (default: all, or a few with --quick): " + stability::questionNames());
    app.add_option("--method", asked.methods, "methods to chart (default: all)");
    app.add_flag("--quick", asked.sweep.quick, "fewer settings, scenes and runs");
    app.add_flag("--peers", asked.peers, "other engines as well, as far as this build has them");
    addDevice(app, asked.device);
    app.add_option("--seed", asked.sweep.seed, "of the scenes")->capture_default_str();
    app.add_option("--steps", asked.steps, "one point only: steps a frame (1/60 s in most scenes)")
        ->check(CLI::Range(0.1, 1000.0));
    app.add_option("--passes", asked.passes, "one point only: iterations or substeps a step")
        ->check(CLI::Range(1, 1000));
    addOutput(app, asked.out, asked.stamp);
    app.add_flag("--questions", asked.printQuestions,
                 "print what each scene asks instead, as a Markdown table");
    if (const auto end = endAfterParsing(app, argc, argv)) return *end;
    return reportingErrors([&] { return runChart(asked); });
}
