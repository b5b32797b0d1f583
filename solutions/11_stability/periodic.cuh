// Chapter 11: a box without walls. What leaves it on one side comes in on the other, so a gas has
// no surface, and what is measured in it can be compared with the laws of an endless one.
//
// Each body has images, one edge of the box further on every side; two bodies meet where one of
// them meets the nearest image of the other (common/bodies.cuh). With three cells or more along
// every axis, the nearest image of anything within reach lies in one of the 27 cells around a body,
// whose indices are taken from the other end where the box ends.
//
// Where it ends: no gravity, since there is nothing to fall to; and the responses that move bodies
// in substeps push against walls and have not been taught to leave that.
#pragma once

#include "10_full_system/engine_stages.cuh"
#include "11_stability/reach.cuh"

namespace ballpit {

/// Along one axis: the place in [lower, upper) that is an image of `place`. A number that is not
/// finite stays so.
HD inline float wrapped(float place, float lower, float upper) {
    if (place >= lower && place < upper) return place;
    const float edge = upper - lower;
    const float inside = place - edge * floorf((place - lower) / edge);
    // Rounding may lead to the upper face, which is the lower one, or just beyond.
    return inside < lower || inside >= upper ? lower : inside;
}

/// Puts body i back into the box.
HD inline void wrapBody(int i, BodiesView bodies, Bounds box) {
    const Vec4 sphere = bodies.positions[i];
    bodies.positions[i] = {wrapped(sphere.x, box.lower.x, box.upper.x),
                           wrapped(sphere.y, box.lower.y, box.upper.y),
                           wrapped(sphere.z, box.lower.z, box.upper.z), sphere.w};
}

/// Which cell is body i in? The last cell along an axis is longer than the others and takes what
/// they leave: nobody is outside.
HD inline void hashInBox(int i, GridView grid, View<const Vec4> positions,
                         View<std::uint32_t> hashes, View<std::uint32_t> indices) {
    hashes[i] = cellHash(grid.resolution, clampToGrid(grid, cellOf(grid, xyz(positions[i]))));
    indices[i] = static_cast<std::uint32_t>(i);
}

/// Moves body i as chapter 07 does, but through the faces; and hashes it.
HD inline void integrateInBox(int i, BodiesView from, BodiesView to, MotionSettings motion,
                              Bounds box, GridView grid, View<std::uint32_t> hashes,
                              View<std::uint32_t> indices, View<StepStatus> status) {
    integrate(i, from, to, motion, status);
    wrapBody(i, to, box);
    hashInBox(i, grid, to.positions, hashes, indices);
}

/// A cell and its two neighbours along an axis that goes on where it ends, in rising order.
struct CellsAround {
    int cells[3];
};
HD inline CellsAround cellsAround(int cell, int count) {
    if (cell == 0) return {{0, 1, count - 1}};
    if (cell == count - 1) return {{0, cell - 1, cell}};
    return {{cell - 1, cell, cell + 1}};
}

/// What the search reads.
struct BoxSearch {
    GridView grid;
    View<const std::uint32_t> sortedHashes;
    View<const Vec4> positions;
    Vec3 period;
};

/// Does one ball touch the nearest image of the other?
HD inline bool touchInBox(Vec4 a, Vec4 b, Vec3 period) {
    const Vec3 between = toNearestImage(xyz(b) - xyz(a), period);
    return spheresTouch({0, 0, 0, a.w}, withW(between, b.w));
}

/// Calls visit(j) for every slot j after i whose body touches body i, in rising order: through the
/// 27 cells around it by rising number, without those that come before its own.
template <class Visit>
HD void visitPartnersInBox(int i, const BoxSearch& search, Visit visit) {
    const Int3 resolution = search.grid.resolution;
    const std::uint32_t own = search.sortedHashes[i], next = static_cast<std::uint32_t>(i) + 1u;
    const Int3 cell = cellFromHash(resolution, own);
    const CellsAround xs = cellsAround(cell.x, resolution.x),
                      ys = cellsAround(cell.y, resolution.y),
                      zs = cellsAround(cell.z, resolution.z);
    for (const int z : zs.cells)
        for (const int y : ys.cells)
            for (const int x : xs.cells) {
                const std::uint32_t there = cellHash(resolution, {x, y, z});
                if (there < own) continue;
                const SlotRange slots = slotsOfRow(search.grid, there, there);
                for (std::uint32_t j = slots.begin < next ? next : slots.begin; j < slots.end; ++j)
                    if (touchInBox(search.positions[i], search.positions[j], search.period))
                        visit(j);
            }
}

HD inline void countPairsInBox(int i, BoxSearch search, View<std::uint32_t> counts) {
    std::uint32_t count = 0;
    visitPartnersInBox(i, search, [&](std::uint32_t) { ++count; });
    counts[i] = count;
}

/// Writes the pairs of body i to its places in the list, as far as there are such. Body 0 also
/// reports how many pairs there are.
HD inline void writePairsInBox(int i, BoxSearch search, PairsView list, View<StepStatus> status) {
    if (i == 0) reportPairs(list.starts[list.starts.count - 1u], status[0]);
    std::uint32_t place = list.starts[i];
    if (list.starts[i + 1] < place) status[0].pairsUncountable = 1;  // the scan ran past 2^32
    visitPartnersInBox(i, search, [&](std::uint32_t j) {
        if (place < list.pairs.count) list.pairs[place] = {static_cast<std::uint32_t>(i), j};
        ++place;
    });
}

/// The stages of a step, which in a periodic box are other ones. They have the names that
/// enqueueStep calls.
class PeriodicStages : public EngineStages {
public:
    explicit PeriodicStages(const SimulatorSettings& settings) : EngineStages(settings) {
        if (settings.periodic) bodies_.period = extent(settings.bounds);
    }

    void integrate(Copies from, Copies to) {
        if (!settings_.periodic) return EngineStages::integrate(from, to);
        timer_.start("integrate + hash");
        launch<integrateInBox>(
            settings_.device, count_, bodies_.view(from), bodies_.view(to),
            MotionSettings{settings_.gravity, settings_.damping, settings_.dt, noWalls()},
            settings_.bounds, grid_.view(), grid_.hashes.view(), grid_.indices.view(),
            status_.view());
    }

    void hash(Copies from) {
        if (!settings_.periodic) return EngineStages::hash(from);
        timer_.start("integrate + hash");
        launch<hashInBox>(settings_.device, count_, grid_.view(), bodies_.view(from).positions,
                          grid_.hashes.view(), grid_.indices.view());
    }

    /// A simple search: twice through the 27 cells.
    void detectCollisions(Copies copies) {
        if (!settings_.periodic) return EngineStages::detectCollisions(copies);
        timer_.start("broad phase");
        const BoxSearch search{grid_.view(), grid_.sortedHashes.view(),
                               bodies_.view(copies).positions, bodies_.period};
        launch<countPairsInBox>(settings_.device, count_, search, pairs_.counts.view());
        exclusiveScan(settings_.device, count_, pairs_.counts.data(), pairs_.starts.data(),
                      scratch_);
        launch<writePairsInBox>(settings_.device, count_, search, pairs_.view(), status_.view());
    }

    void resolveCollisions(Copies from, Copies to, float motionShare) {
        EngineStages::resolveCollisions(from, to, motionShare);
        if (settings_.periodic)
            launch<wrapBody>(settings_.device, count_, bodies_.view(to), settings_.bounds);
    }
};

}  // namespace ballpit
