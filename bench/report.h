// The bench's rows, and how they are printed and saved.
#pragma once

#include <string>
#include <vector>

#include "common/device.h"
#include "common/stage_timer.h"

namespace ballpit {

/// Hash to pair list, and the plain CPU grid in the same run.
struct SearchRow {
    std::string scene, order;  ///< the balls' order in memory: random or cell
    std::size_t balls = 0;
    double pairsPerBall = 0.0;
    double searchMs = 0.0, plainMs = 0.0, ratio = 0.0;  ///< medians; of the ratios too
};

/// A whole step.
struct StepRow {
    std::string scene;
    std::size_t balls = 0;
    double contactsPerBall = 0.0;
    int gridBuilds = 1;
    double stepMs = 0.0;
    std::vector<StageTime> stages;
    double bytes = 0.0;
    double bandwidthShare = 0.0;  ///< of the device's copy bandwidth
};

/// The fewest bytes a step can move: every array that a stage reads or writes, counted once.
double bytesPerStep(const StepRow& row, std::size_t cells, int hashBits, Device device,
                    int iterations);

/// Prints rows as they come, and writes them to a CSV at the end.
class BenchReport {
public:
    /// InputError if `csvPath` is given and cannot be written. `bandwidth` in bytes a second.
    BenchReport(Device device, const std::string& csvPath, double bandwidth);

    void add(const SearchRow& row);
    void add(const StepRow& row);
    /// Prints the table of steps, and writes the CSV if one was asked for.
    void finish();
    double bandwidth() const { return bandwidth_; }

private:
    void writeCsv() const;

    Device device_;
    std::string csvPath_;
    double bandwidth_;
    std::vector<SearchRow> searches_;
    std::vector<StepRow> steps_;
};

}  // namespace ballpit
