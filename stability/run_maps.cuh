// Fills in a map, cell by cell, on all cores; and the table of all maps.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <iostream>
#include <optional>

#include "common/progress.h"
#include "stability/column_maps.cuh"
#include "stability/gas_map.cuh"
#include "stability/hub_map.cuh"
#include "stability/meeting_maps.cuh"
#include "stability/precision_map.cuh"

namespace ballpit::stability {

struct MapKind {
    const char* name;
    Map (*make)(const MapOptions&);
    double seconds, coarseSeconds;  ///< on one core that has nothing else to do, roughly
};

inline const std::vector<MapKind>& mapKinds() {
    static const std::vector<MapKind> kinds{
        {"gas", gasMap, 120, 4},       {"column", columnMap, 8, 1},
        {"heavy", heavyMap, 8, 1},     {"tunnelling", tunnellingMap, 3, 1},
        {"hub", hubMap, 1, 1},         {"penalty", penaltyMap, 1, 1},
        {"overlap", overlapMap, 1, 1}, {"precision", precisionMap, 10, 1}};
    return kinds;
}

/// The outcomes of a map: of each panel, row by row (y), and in a row from left to right (x).
using Outcomes = std::vector<std::vector<Outcome>>;

/// One cell's place.
struct CellPlace {
    std::size_t panel, x, y;
};

inline std::vector<CellPlace> placesOf(const Map& map) {
    std::vector<CellPlace> places;
    for (std::size_t p = 0; p < map.panels.size(); ++p)
        for (std::size_t y = 0; y < map.panels[p].y.values.size(); ++y)
            for (std::size_t x = 0; x < map.panels[p].x.values.size(); ++x)
                places.push_back({p, x, y});
    return places;
}

/// A line for every tenth that is done, but not more than one in two seconds.
class CellCounter {
public:
    CellCounter(const std::string& name, std::size_t cells) : name_(name), cells_(cells) {}
    void done() {
        ++done_;
        const bool tenth = done_ * 10 / cells_ != (done_ - 1) * 10 / cells_;
        if (!tenth || seconds() - shown_ < 2) return;
        shown_ = seconds();
        std::fprintf(stderr, "%s: %zu of %zu cells, %.0f s\n", name_.c_str(), done_, cells_,
                     shown_);
    }

private:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    std::string name_;
    std::size_t cells_, done_ = 0;
    double shown_ = 0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Runs every cell; nothing if the user stopped it. On CPUs a thread a cell: within a cell the
/// engine then runs on one thread, which changes no bit. On a GPU one cell after the other.
inline std::optional<Outcomes> runMap(const Map& map, Device device) {
    const std::vector<CellPlace> places = placesOf(map);
    Outcomes outcomes;
    for (const Panel& panel : map.panels)
        outcomes.emplace_back(panel.x.values.size() * panel.y.values.size());
    CellCounter counter(map.name, places.size());
    std::exception_ptr error;
    std::atomic<bool> failed = false;
    const int count = static_cast<int>(places.size());
#pragma omp parallel for schedule(dynamic, 1) if (device == Device::cpu)
    for (int k = 0; k < count; ++k) {
        if (StopRequest::received() || failed) continue;
        const auto [p, x, y] = places[static_cast<std::size_t>(k)];
        const Panel& panel = map.panels[p];
        try {
            outcomes[p][y * panel.x.values.size() + x] =
                panel.run(panel.x.values[x], panel.y.values[y]);
        } catch (...) {
#pragma omp critical
            error = std::current_exception();
            failed = true;
        }
#pragma omp critical
        counter.done();
    }
    if (error) std::rethrow_exception(error);
    if (StopRequest::received()) return std::nullopt;
    return outcomes;
}

}  // namespace ballpit::stability
