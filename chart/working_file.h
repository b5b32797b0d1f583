// The rows measured so far, on disk: a stop at any moment loses the running point and nothing else.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "chart/row.h"

namespace ballpit::chart {

class WorkingFile {
public:
    /// Takes up the rows in `path` if its first lines are `head` (lines beginning with "# ", which
    /// say all that the rows depend on); a last line that is torn is dropped. Otherwise begins an
    /// empty file.
    WorkingFile(const std::string& path, const std::string& head);
    ~WorkingFile();
    WorkingFile(const WorkingFile&) = delete;

    /// Rows of an earlier run, and whether one was there that does not fit.
    const std::vector<Row>& rows() const { return rows_; }
    bool replacedAnother() const { return replacedAnother_; }

    /// The row of this point, or null.
    const Row* find(const Row& point) const;

    /// Writes one more, at once and whole.
    void append(const Row& row);

    /// All is done: the file goes.
    void remove();

private:
    std::string path_;
    std::FILE* file_ = nullptr;
    std::vector<Row> rows_;
    bool replacedAnother_ = false;
};

}  // namespace ballpit::chart
