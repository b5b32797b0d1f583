// Pictures in a build without graphics: refuses politely.
#include "common/error.h"
#include "common/frame.h"

namespace ballpit {

void writePng(const std::string&, const Frame&) {
    throw InputError(
        "this build has no graphics and cannot write PNG files: install libavcodec-dev and what "
        "else docs/dependencies.md names, and configure again");
}

}  // namespace ballpit
