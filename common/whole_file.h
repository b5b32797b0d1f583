// A text file that appears under its name only when it is complete.
#pragma once

#include <string>

namespace ballpit {

/// InputError unless a file can be made at `path`: the folder exists and can be written.
void requireWritable(const std::string& path);

/// InputError, naming the option --out, unless `path` is a folder.
void requireOutFolder(const std::string& path);

/// Replaces the file `path`. Until the text is on disk, an older one stays as it is. InputError if
/// its folder cannot be written to; a runtime_error if the disk is full, and nothing is left
/// behind.
void writeWhole(const std::string& path, const std::string& text);

}  // namespace ballpit
