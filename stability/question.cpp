// The table of questions.
#include "stability/question.h"

#include <algorithm>
#include <vector>

#include "common/error.h"
#include "common/words.h"
#include "stability/catalogue.h"
#include "stability/gas_truth.h"
#include "stability/meters.h"
#include "stability/scenes.h"

namespace ballpit::stability {

namespace {

const Entry& entryOf(const char* scene) {
    return *std::find_if(catalogue().begin(), catalogue().end(),
                         [&](const Entry& e) { return e.name == std::string(scene); });
}

template <class Kind>
std::unique_ptr<Meter> makeMeter(const Scene& scene, double dt) {
    return std::make_unique<Kind>(scene, dt);
}

constexpr int meetings = 128;
constexpr double gasCollisions = 100, restingSeconds = 3;

std::unique_ptr<Meter> makeResting(const Scene& scene, double dt) {
    return std::make_unique<RestingMeter>(scene, dt, restingSeconds);
}

constexpr int bullets = 16;
constexpr float bulletTravel = 3;

Scene volley(std::uint64_t seed) { return makeVolley(bullets, bulletTravel, seed); }
Scene manyMeetings(std::uint64_t seed) { return makeMeetings(meetings, seed); }

/// The usual 343 balls scatter by 4 % about the mean of many boxes, 1000 by 2 %.
Gas coolingBox(std::uint64_t seed) { return {.count = 1000, .restitution = 0.9f, .seed = seed}; }
Scene largerCooling(std::uint64_t seed) { return makeGasOf(coolingBox(seed)); }

constexpr const char* energyError = "rms energy error |E - E0| / E0";
constexpr const char* conservedError = "error of energy or momentum, the larger";
constexpr const char* overlapError = "rms overlap / r";
constexpr const char* deepestError = "deepest overlap / r";

std::vector<Question> makeQuestions() {
    std::vector<Question> all{
        {"two_bodies", "rms error of the angle, degrees", "truth/collisions.h: scatteringAngle",
         0.2, makeMeter<AngleMeter>, manyMeetings},
        {"bounce", energyError, "constant shadow energy", 20, makeMeter<EnergyMeter>},
        {"newtons_cradle", "largest error of a velocity, m/s", "truth/collisions.h: cradleOneByOne",
         2, makeMeter<CradleMeter>},
        {"pocket", conservedError, "energy and momentum stay", 0.5, makeMeter<ConservationMeter>},
        {"hub", conservedError, "energy and momentum stay", 0.5, makeMeter<ConservationMeter>},
        {"elastic_gas", energyError, "constant energy", gasSeconds({}, gasCollisions),
         makeMeter<EnergyMeter>},
        {"cooling_gas", "|E / E_true - 1| at Haff's time", "the event-driven simulator",
         gasSeconds(coolingBox(1), gasCollisions), makeMeter<CoolingMeter>, largerCooling},
        {"six_cubed", overlapError, "no overlap", 10, makeMeter<OverlapMeter>},
        {"six_cubed_elastic", energyError, "constant shadow energy", 10, makeMeter<EnergyMeter>},
        {"column", deepestError, "no overlap in the last second", restingSeconds, makeResting},
        {"heavy_on_light", deepestError, "no overlap in the last second", restingSeconds,
         makeResting},
        {"deep_pile", overlapError, "no overlap", 5, makeMeter<OverlapMeter>},
        {"mixed_radii", "rms overlap / mean r", "no overlap", 5, makeMeter<OverlapMeter>},
        {"bullet", "rms error of the momentum handed on, as a share", "the event-driven simulator",
         0.1, makeMeter<HandedOnMeter>, volley}};
    for (Question& question : all) question.tolerance = entryOf(question.scene).within;
    return all;
}

}  // namespace

Scene Question::make(std::uint64_t seed) const {
    if (makeOwn) return makeOwn(seed);
    const Entry& entry = entryOf(scene);
    return entry.make(entry.usualCount, seed);
}

std::span<const Question> questions() {
    static const std::vector<Question> all = makeQuestions();
    return all;
}

std::string questionNames() {
    return commaSeparated(questions(), [](const Question& question) { return question.scene; });
}

const Question& question(std::string_view scene) {
    const std::string_view wanted = scene == "666" ? "six_cubed" : scene;
    for (const Question& question : questions())
        if (question.scene == wanted) return question;
    throw InputError("scene '" + std::string(scene) + "': those with an error to chart are " +
                     questionNames() + " (666 is six_cubed)");
}

}  // namespace ballpit::stability
