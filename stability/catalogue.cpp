// The table of scenes.
#include "stability/catalogue.h"
#include "common/words.h"

#include <cstdio>
#include <iterator>

#include "stability/scenes.h"

namespace ballpit::stability {

namespace {

constexpr int million = 1'000'000;

// With one knob, the number of balls; the others as the question is usually asked.

Scene twoBodies(int, std::uint64_t) { return makeTwoBodies({.offset = 0.3f, .phase = 0.5f}); }
Scene bounce(int, std::uint64_t) { return makeBounce(1.0f); }
Scene cradle(int count, std::uint64_t) { return makeCradle(count, false); }
Scene reversedCradle(int count, std::uint64_t) { return makeCradle(count, true); }
Scene pocket(int, std::uint64_t) { return makePocket(1.0f); }
Scene hub(int count, std::uint64_t) { return makeHub({.spokes = count - 1}); }
Scene elasticGas(int count, std::uint64_t seed) {
    return makeGasOf({.count = count, .seed = seed});
}
Scene coolingGas(int count, std::uint64_t seed) {
    return makeGasOf({.count = count, .restitution = 0.9f, .seed = seed});
}
Scene sixCubed(int, std::uint64_t seed) { return makeSixCubed(0.0f, seed); }
Scene sixCubedElastic(int, std::uint64_t seed) { return makeSixCubed(1.0f, seed); }
Scene column(int count, std::uint64_t) { return makeColumn(count, 0.0f); }
Scene heavyOnLight(int, std::uint64_t) { return makeHeavyOnLight(10.0f, 0.0f); }
Scene mixedRadii(int count, std::uint64_t seed) { return makeMixedRadii(count, 3.0f, seed); }
Scene bullet(int count, std::uint64_t) {
    int side = 1;
    while ((side + 1) * (side + 1) * (side + 1) < count) ++side;
    return makeBullet(side, 3.0f);
}
Scene coincident(int count, std::uint64_t) { return makeCoincident(count); }
Scene notFinite(int, std::uint64_t) { return makeNotFinite(); }
Scene farFromOrigin(int count, std::uint64_t) { return makeFarFromOrigin(count, 1e4f); }

const Entry entries[] = {
    {"two_bodies", 2, 2, 2, twoBodies, "Does a collision turn two balls by the right angle?",
     "truth/collisions.h: scatteringAngle, impulseAppliedShare", 5,
     "{} degrees, rms; momentum 1e-6",
     "mass ratio, offset b/sigma, travel v dt/r, phase, restitution"},
    {"bounce", 49, 49, 49, bounce, "How much energy do bounces on a floor cost?",
     "constant shadow energy (what a step costs: truth/motion.h: bounceLoss)", 0.1,
     "{} of the energy, rms, in 20 s", "restitution"},
    {"newtons_cradle", 5, 2, 1000, cradle, "Does only the last ball fly off?",
     "truth/collisions.h: cradleOneByOne", 1e-3, "{} m/s",
     "count (3, 5, 50), order of the numbers"},
    {"newtons_cradle_reversed", 5, 2, 1000, reversedCradle,
     "Does the answer depend on how the balls are numbered?", "the same", 1e-3, "{} m/s",
     "the same"},
    {"pocket", 4, 4, 4, pocket, "Does a ball that meets three at once gain energy?",
     "truth/collisions.h: hubAndSpokesEnergy", 1e-3, "{} of energy and momentum", "restitution"},
    {"hub", 4, 2, 13, hub, "How many contacts at once can a ball take?",
     "truth/collisions.h: hubAndSpokesEnergy", 1e-3, "{} of energy and momentum",
     "spokes, mass ratio, cosine, restitution"},
    {"elastic_gas", 343, 2, million, elasticGas, "Does an elastic gas keep its energy?",
     "truth/kinetic_theory.h: enskogRate, Maxwell and Boltzmann", 0.1,
     "{} of the energy, rms, in 100 collisions a ball",
     "count, volume share (0.05 to 0.49), travel, seed"},
    {"cooling_gas", 343, 2, million, coolingGas, "Does a dull gas cool as Haff's law says?",
     "truth/kinetic_theory.h: haffCooling", 0.1, "{} of the energy at Haff's time",
     "count, volume share, travel, restitution, seed"},
    {"six_cubed", 216, 216, 216, sixCubed, "How deep do balls of a settled heap overlap?",
     "SimBenchmark's 666: no overlap", 0.02, "rms {} r", "restitution 0, seed"},
    {"six_cubed_elastic", 216, 216, 216, sixCubedElastic, "Does a bouncing heap keep its energy?",
     "SimBenchmark's elastic 666: constant shadow energy", 0.1, "{} of the energy, rms, in 10 s",
     "restitution 1, seed"},
    {"column", 10, 1, 1000, column, "How tall a column stands without being squashed?",
     "truth/columns.h: columnOverlap, columnOverlapFloorOnce", 0.1, "{} r", "count, restitution"},
    {"heavy_on_light", 2, 2, 2, heavyOnLight, "How heavy a ball can a light one carry?",
     "truth/columns.h: heavyOnLightRate", 0.1, "{} r", "mass ratio, restitution"},
    {"deep_pile", 1000, 8, million, makeDeepPile, "How deep a pile holds itself up?",
     "truth/columns.h: no random heap is denser than 0.66", 0.05, "rms {} r",
     "count (1 k to 1 M), seed"},
    {"mixed_radii", 500, 8, million, mixedRadii, "Do small balls stay outside of large ones?",
     "truth/columns.h: mostPairsOfAnyBalls", 0.1, "rms {} of the mean radius",
     "count, largest over smallest radius, seed"},
    {"bullet", 126, 2, million, bullet, "Is a fast ball stopped by what it hits?",
     "truth/collisions.h: impulseAppliedShare", 0.1, "{} of the momentum to be handed on, rms",
     "side, travel"},
    {"one_cell", 500, 2, 20000, makeOneCell, "What if all balls lie in one cell?",
     "no ball lost, no pair dropped", 0, "exact", "count, seed"},
    {"coincident", 64, 2, 1024, coincident, "What if two balls have the same centre?",
     "no ball lost, none not finite", 0, "exact", "count"},
    {"not_finite", 2, 2, 2, notFinite, "What if an impulse is too large for a float?",
     "an error that names the ball; the state before it is kept", 0, "exact", ""},
    {"outside", 60, 1, million, makeOutside, "What if balls start outside the walls?",
     "all are back inside after one step", 0, "exact", "count, seed"},
    {"far_from_origin", 3, 1, 1000, farFromOrigin, "What do floats lose 10 km from the origin?",
     "the same column at the origin", 0.1, "{} r", "count, distance"}};

}  // namespace

std::span<const Entry> catalogue() { return entries; }

std::string toleranceText(const Entry& entry) {
    std::string text = entry.tolerance;
    const std::size_t place = text.find("{}");
    return place == std::string::npos ? text : text.replace(place, 2, withDigits(entry.within));
}

}  // namespace ballpit::stability
