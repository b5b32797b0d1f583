// Writes whole files.
#include "common/whole_file.h"

#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "common/csv.h"

namespace ballpit {

void writeWhole(const std::string& path, const std::string& text) {
    requireWritable(path);
    const std::string part = path + ".new";
    std::FILE* file = std::fopen(part.c_str(), "w");
    if (!file) throw std::runtime_error(path + ": cannot be written");
    const bool complete = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    if (std::fclose(file) != 0 || !complete) {
        std::filesystem::remove(part);
        throw std::runtime_error(path + ": writing failed (disk full?); nothing was left behind");
    }
    std::filesystem::rename(part, path);
}

}  // namespace ballpit
