// Chapter 10's executable, gravity_fall: 500 balls fall into a box.
#include "10_full_system/run.cuh"

using namespace ballpit;

int main(int argc, char** argv) {
    return runMain(argc, argv, "Balls fall into a box: the whole pipeline, from scene to video.",
                   Options{}, [](const Options& options) {
                       const Summary summary = runScene(options);
                       printSummary(summary, options.json);
                       constexpr int stoppedByUser = 130;  // what a shell expects after Ctrl-C
                       return summary.interrupted ? stoppedByUser : int(exitOk);
                   });
}
