// Chapter 10's executable, gravity_fall: 500 balls fall into a box.
#include "10_full_system/run.cuh"
#include "chapters/10_full_system/naive_step.cuh"

using namespace ballpit;

static int run(const Options& options) {
    if (options.time) {
        timeStep(options);
        return exitOk;
    }
    const Summary summary = runScene(options);
    printSummary(summary, options.json);
    constexpr int stoppedByUser = 130;  // what a shell expects after Ctrl-C
    return summary.interrupted ? stoppedByUser : int(exitOk);
}

int main(int argc, char** argv) {
    return runMain(argc, argv, "Balls fall into a box: the whole pipeline, from scene to video.",
                   {.timedCount = 50'000}, run);
}
