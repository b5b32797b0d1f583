// Chapter 12: a scene's facts, read on the device. Lane l goes over the bodies l, l + lanes,
// l + 2 lanes, ... and keeps the smallest and largest of what it sees; the host folds the lanes'
// notes, in order. Nothing is added by atomics but integers, and every sum has a fixed shape: so
// the facts, and the plan made from them, are the same bits on every machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "10_full_system/physics_simulator.cuh"
#include "12_speed_and_accuracy/facts.h"

namespace ballpit {

constexpr int mostLanes = 1024;

/// What a lane has seen of its bodies.
struct BodyNotes {
    Vec3 lower, upper;  ///< m: corners of a box around the balls
    float smallestRadius, largestRadius, squaredSpeed, sumOfSquaredSpeeds, squaredSpeedToCome;
    float smallestRestitution, largestRestitution, smallestInverseMass, largestInverseMass;
};

/// What a lane has seen of the pairs in which one of its bodies is the first.
struct PairNotes {
    float massRatio, deepestOverlap;
    std::uint32_t mostContacts, pairs;
};

HD inline Vec3 lowerOf(Vec3 a, Vec3 b) {
    return {minimum(a.x, b.x), minimum(a.y, b.y), minimum(a.z, b.z)};
}
HD inline Vec3 upperOf(Vec3 a, Vec3 b) {
    return {maximum(a.x, b.x), maximum(a.y, b.y), maximum(a.z, b.z)};
}

/// What balls fall to.
struct Fall {
    Vec3 gravity;  ///< m/s^2
    Bounds walls;  ///< m
};

/// J/kg: what gravity along one axis does on the way to the wall below.
HD inline float workAlong(float g, float place, float lower, float upper) {
    return g < 0.0f ? -g * maximum(place - lower, 0.0f) : g * maximum(upper - place, 0.0f);
}
HD inline float workOfFall(Vec3 place, const Fall& fall) {
    const Vec3 g = fall.gravity, lower = fall.walls.lower, upper = fall.walls.upper;
    return workAlong(g.x, place.x, lower.x, upper.x) + workAlong(g.y, place.y, lower.y, upper.y) +
           workAlong(g.z, place.z, lower.z, upper.z);
}

/// Body i alone.
HD inline BodyNotes notesOf(int i, const BodiesView& bodies, const Fall& fall) {
    const Vec4 sphere = bodies.positions[i], moving = bodies.velocities[i];
    const Vec3 r{sphere.w, sphere.w, sphere.w};
    const float squaredSpeed = lengthSquared(xyz(moving)), e = bodies.restitutions[i];
    return {xyz(sphere) - r,
            xyz(sphere) + r,
            sphere.w,
            sphere.w,
            squaredSpeed,
            squaredSpeed,
            squaredSpeed + 2.0f * workOfFall(xyz(sphere), fall),
            e,
            e,
            moving.w,
            moving.w};
}

/// Two notes in one.
HD inline BodyNotes together(const BodyNotes& a, const BodyNotes& b) {
    return {lowerOf(a.lower, b.lower),
            upperOf(a.upper, b.upper),
            minimum(a.smallestRadius, b.smallestRadius),
            maximum(a.largestRadius, b.largestRadius),
            maximum(a.squaredSpeed, b.squaredSpeed),
            a.sumOfSquaredSpeeds + b.sumOfSquaredSpeeds,
            maximum(a.squaredSpeedToCome, b.squaredSpeedToCome),
            minimum(a.smallestRestitution, b.smallestRestitution),
            maximum(a.largestRestitution, b.largestRestitution),
            minimum(a.smallestInverseMass, b.smallestInverseMass),
            maximum(a.largestInverseMass, b.largestInverseMass)};
}

/// Lane `lane` of so many notes down what it sees of `count` bodies; there are at least as many
/// bodies as lanes.
HD inline void noteBodies(int lane, int lanes, int count, BodiesView bodies, Fall fall,
                          View<BodyNotes> notes) {
    BodyNotes seen = notesOf(lane, bodies, fall);
    for (int i = lane + lanes; i < count; i += lanes)
        seen = together(seen, notesOf(i, bodies, fall));
    notes[lane] = seen;
}

/// Counts the pairs of which body i is the first for the bodies that are second.
HD inline void countSeconds(int i, PairsView pairs, View<std::uint32_t> counts) {
    for (std::uint32_t k = pairs.starts[i]; k < pairs.endOf(i); ++k)
        fetchAdd(counts[pairs.pairs[k].second], 1);
}

/// The larger mass over the smaller one.
HD inline float massRatioOf(float inverseA, float inverseB) {
    return maximum(inverseA, inverseB) / minimum(inverseA, inverseB);
}

/// In radii of the smaller ball.
HD inline float overlapInRadii(Vec4 a, Vec4 b) {
    const float smaller = minimum(a.w, b.w);
    return smaller > 0.0f ? (a.w + b.w - length(xyz(b) - xyz(a))) / smaller : 0.0f;
}

/// Lane `lane`, of its bodies' pairs and numbers of contacts.
HD inline void notePairs(int lane, int lanes, int count, BodiesView bodies, PairsView pairs,
                         View<const std::uint32_t> contacts, View<PairNotes> notes) {
    PairNotes seen{1.0f, 0.0f, 0, 0};
    for (int i = lane; i < count; i += lanes) {
        seen.mostContacts = contacts[i] > seen.mostContacts ? contacts[i] : seen.mostContacts;
        seen.pairs += pairs.endOf(i) - pairs.starts[i];
        for (std::uint32_t k = pairs.starts[i]; k < pairs.endOf(i); ++k) {
            const std::uint32_t j = pairs.pairs[k].second;
            seen.massRatio = maximum(seen.massRatio,
                                     massRatioOf(bodies.velocities[i].w, bodies.velocities[j].w));
            seen.deepestOverlap = maximum(seen.deepestOverlap,
                                          overlapInRadii(bodies.positions[i], bodies.positions[j]));
        }
    }
    notes[lane] = seen;
}

/// Reads the facts of a simulator's state, and owns the memory for that.
class FactReader {
public:
    FactReader(Device device, int count)
        : device_(device),
          count_(count),
          lanes_(std::min(count, mostLanes)),
          bodyNotes_(device, static_cast<std::size_t>(lanes_), "bodyNotes"),
          pairNotes_(device, static_cast<std::size_t>(lanes_), "pairNotes") {}

    SceneFacts read(PhysicsSimulator& simulator) {
        const PhysicsSimulator::Survey now = simulator.survey();
        const SimulatorSettings& s = simulator.settings();
        launch<noteBodies>(device_, lanes_, lanes_, count_, now.bodies, Fall{s.gravity, s.bounds},
                           bodyNotes_.view());
        launch<countSeconds>(device_, count_, now.pairs, now.counts);
        launch<notePairs>(device_, lanes_, lanes_, count_, now.bodies, now.pairs,
                          View<const std::uint32_t>(now.counts), pairNotes_.view());
        SceneFacts facts;
        facts.count = count_;
        addBodies(facts);
        addPairs(facts);
        return facts;
    }

private:
    void addBodies(SceneFacts& f) {
        const std::vector<BodyNotes> lanes = bodyNotes_.download();
        BodyNotes all = lanes[0];
        double squares = 0;  // of speeds: the lanes' sums are floats, their sum is not
        for (const BodyNotes& lane : lanes) {
            all = together(all, lane);
            squares += lane.sumOfSquaredSpeeds;
        }
        f.span = {all.lower, all.upper};
        f.smallestRadius = all.smallestRadius, f.largestRadius = all.largestRadius;
        f.largestSpeed = std::sqrt(all.squaredSpeed);
        f.speedToCome = std::sqrt(all.squaredSpeedToCome);
        f.rmsSpeed = static_cast<float>(std::sqrt(squares / count_));
        f.smallestRestitution = all.smallestRestitution;
        f.largestRestitution = all.largestRestitution;
        f.smallestMass = 1.0f / all.largestInverseMass;
        f.largestMass = 1.0f / all.smallestInverseMass;
    }
    void addPairs(SceneFacts& f) {
        for (const PairNotes& lane : pairNotes_.download()) {
            f.massRatio = std::max(f.massRatio, lane.massRatio);
            f.deepestOverlap = std::max(f.deepestOverlap, lane.deepestOverlap);
            f.mostContacts = std::max(f.mostContacts, lane.mostContacts);
            f.pairs += lane.pairs;
        }
    }

    Device device_;
    int count_, lanes_;
    DeviceBuffer<BodyNotes> bodyNotes_;
    DeviceBuffer<PairNotes> pairNotes_;
};

/// The facts of a scene at its start.
inline SceneFacts factsOf(const Scene& scene, Device device) {
    PhysicsSimulator simulator(settingsFor(scene, device));
    simulator.bodies().upload(scene.spheres);
    return FactReader(device, static_cast<int>(scene.spheres.count())).read(simulator);
}

}  // namespace ballpit
