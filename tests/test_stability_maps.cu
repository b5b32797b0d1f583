// Where each response holds and where it fails: of every map a few cells on both sides of the
// boundary, so that a change which moves one is seen. And how maps are run and written.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/with_threads.h"
#include "stability/map_file.h"
#include "stability/run_maps.cuh"
#include "tests/support.h"

using namespace ballpit;
using namespace ballpit::stability;

namespace ballpit::stability {
std::ostream& operator<<(std::ostream& out, Verdict verdict) { return out << name(verdict); }
}  // namespace ballpit::stability

namespace {

using enum ResponseMethod;
constexpr Device cpu = Device::cpu;

// Cells on one thread, as runMap runs them: two would wait for each other in loops this short.

Verdict hub(ResponseMethod method, int spokes, float restitution, double relaxation = 0) {
    const WithThreads one(1);
    return hubCell({.spokes = spokes, .cosine = 0.7f, .restitution = restitution}, method,
                   relaxation, cpu)
        .verdict;
}

Verdict gas(ResponseMethod method, float volumeShare, float travel, float restitution = 1) {
    const WithThreads one(1);
    return gasCell({.count = 125,
                    .volumeShare = volumeShare,
                    .travel = travel,
                    .restitution = restitution},
                   60, method, cpu)
        .verdict;
}

Verdict column(ResponseMethod method, int balls, int passes) {
    const WithThreads one(1);
    return restingCell(makeColumn(balls, dullest(method)), method, passes, 2, cpu).verdict;
}

Verdict heavy(ResponseMethod method, float ratio, int passes) {
    const WithThreads one(1);
    return restingCell(makeHeavyOnLight(ratio, dullest(method)), method, passes, 2, cpu).verdict;
}

Verdict meeting(ResponseMethod method, double travel, double offset) {
    const WithThreads one(1);
    return tunnellingCell(travel, offset, method, cpu).verdict;
}

std::string contentsOf(const std::string& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// One panel of 2 x 2 cells whose outcome is known.
Map tinyMap() {
    Map map{"tiny", "A title?", "it is ok", "a value", {}};
    map.panels.push_back({"a, b",
                          {"x in m", {1, 2}},
                          {"y", {0.5, 1}},
                          [](double x, double y) -> Outcome {
                              if (x > 1 && y < 1) return {Verdict::notFinite, notMeasured};
                              return {x > 1 ? Verdict::energy : Verdict::ok, 10 * x + y};
                          },
                          {{"a line", {{1, 0.5}, {2, 1}}}}});
    return map;
}

}  // namespace

TEST_CASE("plain sums hold with two contacts at once and fail with three", "[stability]") {
    for (const ResponseMethod method : {jacobi, atomic}) {
        CAPTURE(name(method));
        CHECK(hub(method, 2, 1) == Verdict::ok);
        CHECK(hub(method, 3, 1) == Verdict::energy);
        CHECK(hub(method, 5, 0.02f) == Verdict::ok);
        CHECK(hub(method, 7, 0.02f) == Verdict::energy);
    }
    CHECK(hub(jacobi, 6, 1, 0.4) == Verdict::ok);
    CHECK(hub(jacobi, 6, 1, 0.6) == Verdict::energy);
}

TEST_CASE("the plain sum's boundary is the predicted one", "[stability]") {
    for (int spokes = 1; spokes <= 12; ++spokes)
        for (const float e : {0.02f, 0.3f, 0.6f, 1.0f}) {
            CAPTURE(spokes, e);
            const bool safe = truth::plainSumKeepsEnergy(e, spokes * 0.49, 0.5);
            CHECK(hub(jacobi, spokes, e) == (safe ? Verdict::ok : Verdict::energy));
        }
}

TEST_CASE("the staged race holds with one contact and fails with two", "[stability]") {
    CHECK(hub(racy, 1, 1) == Verdict::ok);
    CHECK(hub(racy, 2, 0.1f) == Verdict::inaccurate);
    CHECK(hub(racy, 3, 1) == Verdict::energy);
}

TEST_CASE("split masses, colours and small steps hold with any number of contacts", "[stability]") {
    for (const ResponseMethod method : {massSplit, coloured, smallSteps})
        for (const int spokes : {3, 12}) {
            CAPTURE(name(method), spokes);
            CHECK(hub(method, spokes, 1) == Verdict::ok);
        }
}

TEST_CASE("warm fixes all bounces at once: it holds with two contacts and fails with six",
          "[stability]") {
    CHECK(hub(warm, 2, 1) == Verdict::ok);
    CHECK(hub(warm, 6, 1) == Verdict::energy);
    CHECK(hub(warm, 6, 0.5f) == Verdict::ok);
}

TEST_CASE("an elastic gas: who holds where it is thin, and who where it is dense",
          "[stability][long]") {
    for (const ResponseMethod method : {jacobi, atomic}) {
        CHECK(gas(method, 0.05f, 0.02f) == Verdict::ok);
        CHECK(gas(method, 0.4f, 0.1f) == Verdict::energy);
    }
    CHECK(gas(coloured, 0.4f, 0.1f) == Verdict::ok);
    CHECK(gas(coloured, 0.4f, 0.8f) == Verdict::ok);
    CHECK(gas(coloured, 0.1f, 0.05f, 0.9f) == Verdict::ok);
    CHECK(gas(coloured, 0.1f, 0.8f, 0.9f) == Verdict::inaccurate);
    CHECK(gas(penalty, 0.1f, 0.05f) == Verdict::ok);
    CHECK(gas(penalty, 0.48f, 0.8f) == Verdict::inaccurate);
    CHECK(gas(massSplit, 0.4f, 0.1f) == Verdict::inaccurate);
    CHECK(gas(smallSteps, 0.4f, 0.1f) == Verdict::ok);
    CHECK(gas(warm, 0.05f, 0.02f) == Verdict::ok);
    CHECK(gas(warm, 0.4f, 0.1f) == Verdict::inaccurate);
    CHECK(gas(racy, 0.4f, 0.1f) == Verdict::energy);
}

TEST_CASE("a column: rounds hold four balls however many, memory and substeps hold more",
          "[stability]") {
    for (const ResponseMethod method : {jacobi, atomic, massSplit, coloured}) {
        CAPTURE(name(method));
        CHECK(column(method, 4, 8) == Verdict::ok);
        CHECK(column(method, 5, 8) == Verdict::inaccurate);
        CHECK(column(method, 5, 32) == Verdict::inaccurate);
    }
    CHECK(column(racy, 2, 2) == Verdict::ok);
    CHECK(column(racy, 4, 2) == Verdict::inaccurate);
    CHECK(column(warm, 20, 2) == Verdict::ok);
    CHECK(column(warm, 20, 1) == Verdict::inaccurate);
    CHECK(column(smallSteps, 20, 4) == Verdict::ok);
    CHECK(column(smallSteps, 20, 1) == Verdict::inaccurate);
    CHECK(column(penalty, 5, 4) == Verdict::ok);
    CHECK(column(penalty, 5, 1) == Verdict::inaccurate);
    CHECK(column(coloured, 10, 1) == Verdict::lost);
}

TEST_CASE("heavy on light: rounds hold a ratio of three, however many", "[stability]") {
    for (const int passes : {1, 16}) {
        CHECK(heavy(coloured, 3, passes) == Verdict::ok);
        CHECK(heavy(coloured, 5, passes) == Verdict::inaccurate);
    }
    CHECK(heavy(warm, 20, 1) == Verdict::ok);
    CHECK(heavy(warm, 50, 1) == Verdict::inaccurate);
    CHECK(heavy(smallSteps, 100, 4) == Verdict::ok);
    CHECK(heavy(smallSteps, 100, 1) == Verdict::inaccurate);
    CHECK(heavy(penalty, 5, 4) == Verdict::ok);
    CHECK(heavy(penalty, 5, 1) == Verdict::inaccurate);
}

TEST_CASE("fast balls: first the angle goes, then the collision", "[stability]") {
    for (const ResponseMethod method : {coloured, warm}) {
        CAPTURE(name(method));
        CHECK(meeting(method, 0.2, 0.5) == Verdict::ok);
        CHECK(meeting(method, 0.5, 0.5) == Verdict::inaccurate);
        CHECK(meeting(method, 3, 0.5) == Verdict::lost);
    }
    CHECK(meeting(smallSteps, 0.5, 0.5) == Verdict::ok);
    CHECK(meeting(smallSteps, 3, 0.5) == Verdict::inaccurate);
    CHECK(meeting(penalty, 0.1, 0.5) == Verdict::ok);
    CHECK(meeting(penalty, 1, 0.5) == Verdict::inaccurate);
}

TEST_CASE("an overlap at the start: only springs make energy of it", "[stability]") {
    const Scene scene = overlappingPair(0.5, 0.5f);
    for (const ResponseMethod method : {jacobi, coloured, warm, smallSteps}) {
        CAPTURE(name(method));
        CHECK(overlapCell(0.5, settingsWith(scene, cpu, method), scene).verdict == Verdict::ok);
    }
    CHECK(overlapCell(0.5, settingsWith(scene, cpu, penalty, 1), scene).verdict == Verdict::energy);
    const Scene little = overlappingPair(0.02, 0.5f);
    CHECK(overlapCell(0.02, settingsWith(little, cpu, penalty, 2), little).verdict == Verdict::ok);
}

TEST_CASE("a penalty contact of 20 steps holds, one of three fails, one of two gains energy",
          "[stability]") {
    CHECK(penaltyCell(0.05, 0.5).verdict == Verdict::ok);
    CHECK(penaltyCell(0.05, 1).verdict == Verdict::ok);
    CHECK(penaltyCell(0.3, 0.5).verdict == Verdict::inaccurate);
    CHECK(penaltyCell(0.5, 1).verdict == Verdict::energy);
}

TEST_CASE("falling far away: a step must move farther than half of what floats can tell",
          "[stability]") {
    CHECK(precisionCell(1000, 0.001, coloured, cpu).verdict == Verdict::ok);
    CHECK(precisionCell(1e6, 0.001, coloured, cpu).verdict == Verdict::inaccurate);
    CHECK(precisionCell(1e5, 0.05, coloured, cpu).verdict == Verdict::ok);
    CHECK(precisionCell(1e5, 0.001, coloured, cpu).verdict == Verdict::inaccurate);
}

TEST_CASE("what breaks a run off becomes its verdict; a wrong setting does not") {
    const auto throwing = [](auto error) { return outcomeOf([&]() -> Outcome { throw error; }); };
    CHECK(throwing(NotFiniteError("body 3")).verdict == Verdict::notFinite);
    CHECK(throwing(std::runtime_error("pair list full")).verdict == Verdict::overflow);
    CHECK(test::messageOf<InputError>([&] { throwing(InputError("no such knob")); }) ==
          "no such knob");
    const Scene scene = makeNotFinite();
    const Outcome outcome = outcomeOf([&]() -> Outcome {
        Trial(scene, settingsWith(scene, cpu, coloured)).step();
        return {Verdict::ok, 0};
    });
    CHECK(outcome.verdict == Verdict::notFinite);
}

TEST_CASE("more pairs than balls without overlap can have are an overflow") {
    const Scene scene = makeOneCell(200, 1);
    const Outcome outcome = outcomeOf([&]() -> Outcome {
        Trial(scene, settingsWith(scene, cpu, coloured)).step();
        return {Verdict::ok, 0};
    });
    CHECK(outcome.verdict == Verdict::overflow);
}

TEST_CASE("a map's cells come out in their places, twice the same") {
    const MapOptions options{.coarse = true};
    const Map map = hubMap(options);
    const std::optional<Outcomes> first = runMap(map, cpu), second = runMap(map, cpu);
    REQUIRE((first && second));
    for (std::size_t p = 0; p < map.panels.size(); ++p)
        for (std::size_t k = 0; k < (*first)[p].size(); ++k) {
            CHECK((*first)[p][k].verdict == (*second)[p][k].verdict);
            CHECK((*first)[p][k].value == (*second)[p][k].value);
        }
    const std::optional<Outcomes> tiny = runMap(tinyMap(), cpu);
    REQUIRE(tiny);
    CHECK((*tiny)[0][0].value == 10.5);
    CHECK((*tiny)[0][1].verdict == Verdict::notFinite);
    CHECK((*tiny)[0][2].value == 11.0);
    CHECK((*tiny)[0][3].value == 21.0);
}

TEST_CASE("a map that is stopped has no outcome") {
    {
        const StopRequest stop;
        std::raise(SIGINT);
        CHECK_FALSE(runMap(tinyMap(), cpu));
    }
    const StopRequest forgotten;
    CHECK(runMap(tinyMap(), cpu));
}

TEST_CASE("an error in a cell ends the map") {
    Map map = tinyMap();
    map.panels[0].run = [](double, double) -> Outcome { throw InputError("no such knob"); };
    CHECK(test::messageOf<InputError>([&] { runMap(map, cpu); }) == "no such knob");
}

TEST_CASE("a map's file says what it is, cell by cell, and leaves nothing half done") {
    const std::string path = "tiny_map.csv";
    const Map map = tinyMap();
    const std::vector<std::vector<Outcome>> outcomes = *runMap(map, cpu);
    writeMap(path, map, outcomes, "a machine, commit 1\n./ballpit maps tiny");
    CHECK(contentsOf(path) ==
          "# map: tiny\n# title: A title?\n# ok: it is ok\n# value: a value\n"
          "# a machine, commit 1\n# ./ballpit maps tiny\n"
          "kind,panel,x,y,verdict,value,label\n"
          "axes,\"a, b\",\"x in m\",\"y\",,,\n"
          "cell,\"a, b\",1,0.5,ok,10.5,\n"
          "cell,\"a, b\",2,0.5,not finite,nan,\n"
          "cell,\"a, b\",1,1,ok,11,\n"
          "cell,\"a, b\",2,1,energy,21,\n"
          "line,\"a, b\",1,0.5,,,\"a line\"\n"
          "line,\"a, b\",2,1,,,\"a line\"\n");
    CHECK_FALSE(std::filesystem::exists(path + ".part"));
    std::filesystem::remove(path);
    CHECK(test::contains(
        test::messageOf<InputError>([&] { writeMap("no/such/folder.csv", map, outcomes, ""); }),
        "does not exist"));
}
