// Xlib's three handlers.
#include "common/display_loss.h"

#include <GL/glx.h>
#include <X11/Xlib.h>

#include <atomic>

namespace ballpit {
namespace {

/// Xlib's handlers get no data of ours, so the note is the process's.
std::atomic<bool>& lost() {
    static std::atomic<bool> value = false;
    return value;
}

int noteError(Display*, XErrorEvent* error) {
    const bool windowIsGone = error->error_code == BadWindow || error->error_code == BadDrawable;
    if (windowIsGone) lost() = true;
    return 0;  // the failed request did nothing, and nothing else is wrong
}

int noteBreak(Display*) {
    lost() = true;
    return 0;
}

}  // namespace

void surviveDisplayLoss() {
    lost() = false;
    XSetErrorHandler(noteError);
    XSetIOErrorHandler(noteBreak);
    // Called after noteBreak: to return is to go on. The default is to exit.
    XSetIOErrorExitHandler(
        glXGetCurrentDisplay(), [](Display*, void*) {}, nullptr);
}

bool displayLost() { return lost(); }

}  // namespace ballpit
