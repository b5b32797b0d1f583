// How long each stage takes, for scenes of growing size: `./ballpit bench`.
#include <iostream>

#include "bench/bench.cuh"
#include "bench/drop.cuh"
#include "bench/frames.h"
#include "common/cli.h"
#include "common/error.h"

using namespace ballpit;

int main(int argc, char** argv) {
    CLI::App app{"Times the engine: each stage's median ms, by scene and number of balls."};
    BenchPlan plan;
    plan.device = defaultDevice();
    addDevice(app, plan.device);
    app.add_option("--counts", plan.counts,
                   "numbers of balls (default: 1 k to 1 M on a CPU, "
                   "1 k to 8 M on a GPU)");
    app.add_option("--scenes", plan.scenes, "uniform, gas, pile")->capture_default_str();
    app.add_option("--repeats", plan.repeats, "timed steps; the median is shown")
        ->capture_default_str()
        ->check(CLI::Range(3, 10000));
    app.add_option("--csv", plan.csv, "file to write the table to as well");
    bool frames = false;
    app.add_flag("--frames", frames, "time steps that are drawn as well, offscreen at 1920x1080");
    bool drop = false;
    DropPlan fall;
    app.add_flag(
        "--drop", drop,
        "balls dropped into a box under small-steps: ms a step, and how deep they overlap");
    app.add_option("--substeps", fall.substeps, "with --drop: one line for each")
        ->check(CLI::Range(1, 1000));
    app.add_option("--rest", fall.rest, "with --drop: steps after the fall, untimed")
        ->check(CLI::Range(0, 100000));
    if (const auto end = endAfterParsing(app, argc, argv)) return *end;
    return reportingErrors([&] {
        if (drop) {
            fall.device = plan.device;
            if (!plan.counts.empty()) fall.counts = plan.counts;
            if (app.count("--repeats")) fall.repeats = plan.repeats;
            runDropBench(fall);
        } else if (frames)
            runFramesBench({plan.device, plan.counts, plan.repeats, plan.csv});
        else
            runBench(plan);
        return int(exitOk);
    });
}
