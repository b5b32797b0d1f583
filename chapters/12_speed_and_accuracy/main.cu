// Chapter 12's executable: scenes under the original loop and under what the plan chooses: how
// wrong each is and what it costs; then the front of more loops in one scene.
#include "chapters/12_speed_and_accuracy/chart.cuh"
#include "chapters/12_speed_and_accuracy/film.cuh"

using namespace ballpit;

static int run(const Options& options) {
    Findings findings("12 speed and accuracy: the original loop, and what the plan chooses");
    const Questions questions = questionsNamed(options.scene);
    const bool isShown = options.isFilmed() || !options.png.empty();
    if (isShown) requireFilmed(options.scene);
    if (options.time) {
        tellSpeeds(findings, questions, options);
    } else {
        for (const stability::Question* question : questions)
            tellBoth(findings, *question, options);
        tellFront(findings, *questions.front(), options);
        tellExample(findings);
    }
    findings.print(options.json);
    if (isShown) film666(options);
    return 0;
}

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Speed against accuracy: the original loop and the plan",
                      {.scene = "few", .sceneChoice = questionChoice(), .frames = 300}, run);
}
