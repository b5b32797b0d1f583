// The same packets in another file: nothing is decoded, nothing is lost.
#pragma once

#include <filesystem>

namespace ballpit {

/// Copies a video of one stream into a plain file whose index is in front, so that a browser can
/// start to play before it has it all. Its first frame is shown at 0. Throws std::runtime_error.
void copyStream(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace ballpit
