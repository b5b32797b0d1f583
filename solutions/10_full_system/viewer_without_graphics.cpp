// The window of a build without graphics: refuses politely.
#include "10_full_system/viewer.h"

#include "common/error.h"

namespace ballpit {

void runBesideWindow(const Options&, const Scene&, const std::function<void(ViewerLink*)>&) {
    throw InputError(
        "this build has no graphics, so --view cannot be used: install the packages named in "
        "docs/dependencies.md and configure again, or leave it away");
}

}  // namespace ballpit
