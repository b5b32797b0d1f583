// A window onto a simulation that runs beside it, in a thread of its own.
#pragma once

#include <functional>

#include "10_full_system/viewer_link.h"
#include "common/options.h"
#include "common/scene.h"

namespace ballpit {

/// Opens a window, calls `simulate` on another thread, and serves the window until the user closes
/// it, Ctrl-C comes, or `simulate` is done; then waits for `simulate` to end, which the link's
/// wishes tell it to. An exception from it goes on from here. InputError if no window can be opened
/// or this build has no graphics.
void runBesideWindow(const Options& options, const Scene& scene,
                     const std::function<void(ViewerLink*)>& simulate);

}  // namespace ballpit
