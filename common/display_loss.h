// What Xlib does when a window or its display is taken away: by default it ends the process.
#pragma once

namespace ballpit {

/// From now on that is only noted, for windows on the display of the OpenGL context that is
/// current: so recordings can be completed.
void surviveDisplayLoss();

/// True once our window was destroyed by another program, or the connection to its display broke.
bool displayLost();

}  // namespace ballpit
