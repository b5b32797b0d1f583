// Chapter 12: what follows from a scene's facts. On the host, in double precision.
#include "12_speed_and_accuracy/facts.h"

#include <algorithm>
#include <cmath>

namespace ballpit {

namespace {

constexpr double pi = 3.14159265358979;
constexpr double heapedShare = 0.6;  // of a heap's volume is ball

struct Box {
    double x, y, z;
};

double overlap(double lowerA, double upperA, double lowerB, double upperB) {
    return std::max(0.0, std::min(upperA, upperB) - std::max(lowerA, lowerB));
}

/// The edges of the box around the balls, as far as it lies within the walls.
Box spanOf(const SceneFacts& f, const World& w) {
    return {overlap(f.span.lower.x, f.span.upper.x, w.walls.lower.x, w.walls.upper.x),
            overlap(f.span.lower.y, f.span.upper.y, w.walls.lower.y, w.walls.upper.y),
            overlap(f.span.lower.z, f.span.upper.z, w.walls.lower.z, w.walls.upper.z)};
}

}  // namespace

World worldOf(const Scene& scene) {
    World world{scene.bounds,  scene.gravity, scene.damping, scene.dt, scene.cellSize, 0, 0, 0,
                scene.periodic};
    for (const double r : scene.spheres.radii) {
        world.ballVolume += 4.0 / 3.0 * pi * r * r * r;
        world.meanRadius += r / static_cast<double>(scene.spheres.count());
    }
    for (const double m : scene.spheres.masses) world.ballMass += m;
    return world;
}

double volumeShare(const SceneFacts& f, const World& w) {
    const Box s = spanOf(f, w);
    const double volume = s.x * s.y * s.z;
    return volume > 0 ? w.ballVolume / volume : 1.0;
}

double floorCovered(const SceneFacts& f, const World& w) {
    const Box s = spanOf(f, w);
    const double x = std::fabs(w.gravity.x), y = std::fabs(w.gravity.y), z = std::fabs(w.gravity.z);
    const double area = y >= x && y >= z ? s.x * s.z : x >= z ? s.y * s.z : s.x * s.y;
    return std::max(area, pi * f.smallestRadius * f.smallestRadius);
}

double depthInBalls(const SceneFacts& f, const World& w) {
    if (length(w.gravity) == 0.0f) return 0;
    return w.ballVolume / heapedShare / floorCovered(f, w) / (2 * w.meanRadius);
}

double loadOnLightest(const SceneFacts& f, const World& w) {
    if (length(w.gravity) == 0.0f) return 0;
    const double square = 4.0 * f.smallestRadius * f.smallestRadius;
    const double share = std::min(1.0, square / floorCovered(f, w));
    return (w.ballMass - f.smallestMass) * share / f.smallestMass;
}

double farthestCoordinate(const World& w) {
    double farthest = 0;
    for (const float c : {w.walls.lower.x, w.walls.lower.y, w.walls.lower.z, w.walls.upper.x,
                          w.walls.upper.y, w.walls.upper.z})
        farthest = std::max(farthest, std::fabs(double(c)));
    return farthest;
}

double floatsPerStep(const SceneFacts& f, const World& w, double dt) {
    const double spacing = farthestCoordinate(w) * 0x1p-23;
    const double g = length(w.gravity);
    const double way = g > 0 ? g * dt * dt : double(f.largestSpeed) * dt;
    return way / spacing;
}

}  // namespace ballpit
