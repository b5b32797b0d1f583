// OpenGL's functions, loaded for windows and offscreen contexts alike.
#pragma once

#include <string>

namespace ballpit {

/// Loads OpenGL's functions, once for all contexts of the process (their addresses are the same),
/// and says what the current context lacks for our pictures: nothing, or words such as "the
/// driver's OpenGL is 1.4, and 2.1 is needed".
std::string loadOpenGL();

}  // namespace ballpit
