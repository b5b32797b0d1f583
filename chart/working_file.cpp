// Implements the working file.
#include "chart/working_file.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "common/whole_file.h"

namespace ballpit::chart {

namespace {

std::string contentsOf(const std::string& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

bool isSamePoint(const Row& a, const Row& b) {
    return a.scene == b.scene && a.method == b.method && a.knobs == b.knobs;
}

}  // namespace

WorkingFile::WorkingFile(const std::string& path, const std::string& head) : path_(path) {
    const std::string text = contentsOf(path);
    std::string kept = head;
    if (text.rfind(head, 0) == 0) {
        std::istringstream lines(text.substr(head.size()));
        for (std::string line; std::getline(lines, line) && !lines.eof();) {
            const std::optional<Row> row = rowOf(line);
            if (!row) continue;
            rows_.push_back(*row);
            kept += line + '\n';
        }
    } else {
        replacedAnother_ = !text.empty();
    }
    writeWhole(path, kept);  // without what was torn, and with the old one there until it is done
    file_ = std::fopen(path.c_str(), "a");
    if (!file_) throw std::runtime_error(path + ": cannot be written");
}

WorkingFile::~WorkingFile() {
    if (file_) std::fclose(file_);
}

const Row* WorkingFile::find(const Row& point) const {
    for (const Row& row : rows_)
        if (isSamePoint(row, point)) return &row;
    return nullptr;
}

void WorkingFile::append(const Row& row) {
    rows_.push_back(row);
    const std::string line = lineOf(row) + '\n';
    if (std::fputs(line.c_str(), file_) < 0 || std::fflush(file_) != 0)
        throw std::runtime_error(path_ +
                                 ": writing failed (disk full?); the rows before it are kept");
}

void WorkingFile::remove() {
    std::fclose(file_);
    file_ = nullptr;
    std::filesystem::remove(path_);
}

}  // namespace ballpit::chart
