// Byte counts, table and CSV.
#include "bench/report.h"

#include <cstdio>

#include "common/whole_file.h"
#include "common/words.h"

namespace ballpit {

double bytesPerStep(const StepRow& row, std::size_t cells, int hashBits, Device device,
                    int iterations) {
    const double balls = static_cast<double>(row.balls);
    const double pairs = 0.5 * row.contactsPerBall * balls;
    const double cellArrays = 8.0 * static_cast<double>(cells);
    // position + velocity 32, restitution 4, id 4, hash 4, index 4
    const double integrateAndHash = (32 + 4 + 4 + 32 + 8) * balls;
    const int digitBits = device == Device::cuda ? 8 : 11;
    const int passes = (hashBits + digitBits - 1) / digitBits;
    const double sort = (passes * 16.0 + 4.0) * balls;
    const double reorder = (4 + 40 + 40 + 4) * balls + 2 * cellArrays;
    // hash, position, count, start written and read; pairs remembered, read back, written
    const double broadPhase = (4 + 16 + 4 + 4 + 4 + 4) * balls + cellArrays + 16 * pairs;
    // incoming counts and starts, contact counts, bodies read twice, written once
    const double response = (16 + 16 + 2 * 36 + 4 + 32) * balls + (3 * 8 + 3 * 4) * pairs;
    return integrateAndHash + row.gridBuilds * (sort + reorder) +
           (row.gridBuilds - 1) * 24.0 * balls + iterations * (broadPhase + response);
}

BenchReport::BenchReport(Device device, const std::string& csvPath, double bandwidth)
    : device_(device), csvPath_(csvPath), bandwidth_(bandwidth) {
    if (!csvPath.empty()) requireWritable(csvPath);
    std::printf("%s: %s, copies %.1f GB/s\n\n", name(device), describe(device).c_str(),
                1e-9 * bandwidth);
    std::printf(
        "Hash to pair list, against a plain counting-sort grid on the CPU in the same run\n");
    std::printf("%-8s %9s  %-7s %10s %10s %10s %7s\n", "scene", "balls", "memory", "pairs/ball",
                "ms", "plain ms", "ratio");
}

void BenchReport::add(const SearchRow& row) {
    std::printf("%-8s %9zu  %-7s %10.2f %10.3f %10.3f %7.3f\n", row.scene.c_str(), row.balls,
                row.order.c_str(), row.pairsPerBall, row.searchMs, row.plainMs, row.ratio);
    std::fflush(stdout);
    searches_.push_back(row);
}

void BenchReport::add(const StepRow& row) { steps_.push_back(row); }

void BenchReport::finish() {
    std::printf("\nWhole steps: two rounds of detect and resolve, medians in ms\n");
    std::printf("%-8s %9s %9s %6s %9s %9s %8s %7s %6s", "scene", "balls", "contacts", "grids",
                "step", "Mballs/s", "MB", "GB/s", "share");
    if (!steps_.empty())
        for (const StageTime& stage : steps_[0].stages) std::printf("  %s", stage.stage.c_str());
    std::printf("\n");
    for (const StepRow& row : steps_) {
        std::printf("%-8s %9zu %9.2f %6d %9.4f %9.1f %8.1f %7.1f %5.1f%%", row.scene.c_str(),
                    row.balls, row.contactsPerBall, row.gridBuilds, row.stepMs,
                    1e-3 * static_cast<double>(row.balls) / row.stepMs, 1e-6 * row.bytes,
                    1e-6 * row.bytes / row.stepMs, 100.0 * row.bandwidthShare);
        for (const StageTime& stage : row.stages)
            std::printf("  %*.4f", static_cast<int>(stage.stage.size()), stage.milliseconds);
        std::printf("\n");
    }
    if (!csvPath_.empty()) writeCsv();
}

void BenchReport::writeCsv() const {
    char copies[64];
    std::snprintf(copies, sizeof copies, ", copies %.1f GB/s\n", 1e-9 * bandwidth_);
    std::string text = "# " + describe(device_) + copies + "device,scene,balls,what,value\n";
    const auto put = [&](const std::string& scene, std::size_t balls, const std::string& what,
                         double value) {
        text += std::string(name(device_)) + ',' + scene + ',' + std::to_string(balls) + ',' +
                what + ',' + withDigits(value) + '\n';
    };
    for (const SearchRow& row : searches_) {
        put(row.scene, row.balls, "pairs per ball", row.pairsPerBall);
        put(row.scene, row.balls, "hash to pair list ms (memory " + row.order + ")", row.searchMs);
        put(row.scene, row.balls, "plain grid ms (memory " + row.order + ")", row.plainMs);
        put(row.scene, row.balls, "ratio (memory " + row.order + ")", row.ratio);
    }
    for (const StepRow& row : steps_) {
        put(row.scene, row.balls, "contacts per ball", row.contactsPerBall);
        put(row.scene, row.balls, "grid builds per step", row.gridBuilds);
        put(row.scene, row.balls, "step ms", row.stepMs);
        put(row.scene, row.balls, "bytes moved", row.bytes);
        put(row.scene, row.balls, "share of copy bandwidth", row.bandwidthShare);
        for (const StageTime& stage : row.stages)
            put(row.scene, row.balls, stage.stage + " ms", stage.milliseconds);
    }
    writeWhole(csvPath_, text);
}

}  // namespace ballpit
