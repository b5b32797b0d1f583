// Chapter 12's executable.
#include "common/options.h"
int main(int argc, char** argv) {
    return ballpit::runChapter(argc, argv, "x", {}, [](const ballpit::Options&) { return 0; });
}
