// Writes whole files.
#include "common/whole_file.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "common/error.h"

namespace ballpit {

void requireWritable(const std::string& path) {
    namespace fs = std::filesystem;
    fs::path folder = fs::path(path).parent_path();
    if (folder.empty()) folder = ".";
    if (!fs::is_directory(folder))
        throw InputError(path + ": folder " + folder.string() + " does not exist");
    if (fs::is_directory(path)) throw InputError(path + ": is a folder, not a file name");
    if (access(folder.c_str(), W_OK) != 0)
        throw InputError(path + ": folder " + folder.string() + " cannot be written to");
}

void requireOutFolder(const std::string& path) {
    if (!std::filesystem::is_directory(path))
        throw InputError("--out " + path + ": is not a folder");
}

void writeWhole(const std::string& path, const std::string& text) {
    requireWritable(path);
    const std::string part = path + ".part";
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
