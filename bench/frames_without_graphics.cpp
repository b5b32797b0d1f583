// The frames' bench of a build without graphics: refuses politely.
#include "bench/frames.h"
#include "common/error.h"

namespace ballpit {

void runFramesBench(const FramesPlan&) {
    throw InputError(
        "this build has no graphics, so it cannot draw frames: install the packages named in "
        "docs/dependencies.md and configure again");
}

}  // namespace ballpit
