// The chart: which points are on the front, what a point is, and what becomes of wrong ones, with
// an engine that does what the test wants.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "12_speed_and_accuracy/pareto_front.h"
#include "chart/measure.h"
#include "chart/run_chart.h"
#include "chart/working_file.h"
#include "common/error.h"
#include "tests/catch.h"
#include "tests/support.h"

using namespace ballpit;
using namespace ballpit::chart;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Leaves the balls where they are, or does what the test says; counts its runs.
class FakeRunner : public Runner {
public:
    std::string engine() const override { return "fake"; }
    std::string method() const override { return "fake"; }
    std::string passesName() const override { return "rounds"; }
    Knobs usual() const override { return {1, 4}; }
    std::vector<int> passesToTry() const override { return {1, 2, 4, 8}; }

    RunResult run(const Scene& scene, const Knobs& knobs, double seconds, Meter* meter) override {
        ++(meter ? metered : timed);
        RunResult result;
        if (meter) {
            Spheres state = scene.spheres;
            if (losesABall) state.positions[0].y = 1e6f;
            result.cost.simulatedSeconds = forEachStep(
                scene, knobs, seconds, [] {},
                [&](double time) { return meter->add(state, time), !meter->hasFailed(); });
            result.cost.pairVisits = 100 * result.cost.simulatedSeconds;
            return result;
        }
        if (failsWhenTimed) return {.verdict = Verdict::overflow};
        result.cost.simulatedSeconds = 1;
        result.cost.milliseconds = 600 + 10 * (timed % 3);
        return result;
    }

    bool losesABall = false, failsWhenTimed = false;
    int metered = 0, timed = 0;
};

const Setting usualSetting{{1, 4}, "both"};

Row measured(FakeRunner& runner) {
    return measuredRow(stability::question("column"), runner, usualSetting, {}).value();
}

Row exampleRow() {
    Row row{.scene = "column", .engine = "fake 1.0", .method = "fake", .curve = "dt"};
    row.knobs = {0.5, 3};
    row.dt = 0.025;
    row.passesName = "rounds";
    row.label = "dt 25 ms, 3 rounds";
    row.error = 0.125;
    row.tolerance = 0.5;
    row.verdict = "ok";
    row.milliseconds = {10, 8, 16};
    row.pairVisits = 1000;
    row.runs = 5;
    row.command = "./ballpit chart --steps 0.5";
    return row;
}

std::string contentsOf(const std::string& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// A folder that goes when the test ends.
struct Folder {
    Folder() { std::filesystem::create_directory(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string path =
        (std::filesystem::temp_directory_path() / ("ballpit_chart_" + std::to_string(getpid())))
            .string();
    std::string part = path + "/chart.part";
};

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

}  // namespace

TEST_CASE("the front has the points that no other beats in both, and no others") {
    // The second is slower and less accurate than the first; the others trade.
    const WorkPoint points[] = {{10, 1e-3}, {5, 1e-2}, {20, 1e-1}, {1, 1e-5}};
    CHECK(paretoFront(points) == std::vector<bool>{true, false, true, true});
}

TEST_CASE("a point that is as fast as another and less accurate is not on the front") {
    const WorkPoint points[] = {{10, 1e-3}, {10, 1e-2}, {9, 1e-3}};
    CHECK(paretoFront(points) == std::vector<bool>{true, false, false});
}

TEST_CASE("equal points are on the front together") {
    const WorkPoint points[] = {{10, 1e-3}, {10, 1e-3}};
    CHECK(paretoFront(points) == std::vector<bool>{true, true});
    CHECK(paretoFront({}).empty());
}

TEST_CASE("a point that failed is never on the front, and keeps none from it") {
    const WorkPoint points[] = {{100, 0, true}, {1, 1}, {2, nothing, true}};
    CHECK(paretoFront(points) == std::vector<bool>{false, true, false});
}

TEST_CASE("a right result is timed, and its row has median and spread") {
    FakeRunner runner;
    const Row row = measured(runner);
    CHECK(row.verdict == "ok");
    CHECK(runner.metered == 1);
    CHECK(runner.timed == 5);
    CHECK(row.runs == 5);
    CHECK(row.milliseconds.low == 600);
    CHECK(row.milliseconds.median == 610);
    CHECK(row.milliseconds.high == 620);
    CHECK(row.realTimeFactor() == Approx(1000.0 / 610));
    CHECK(row.pairVisits == Approx(100));
    CHECK(row.error == Approx(0).margin(1e-5));
    CHECK(row.command == "./ballpit chart --scene column --method fake --steps 1 --passes 4");
}

TEST_CASE("a wrong result is never timed, and its row stays with its verdict") {
    FakeRunner runner;
    runner.losesABall = true;
    const Row row = measured(runner);
    CHECK(row.verdict == "lost");
    CHECK(runner.timed == 0);
    CHECK(row.runs == 0);
    CHECK(std::isnan(row.milliseconds.median));
    const std::string text =
        chartText(stability::question("column"), "# here\n", {row, exampleRow()});
    CHECK(test::contains(text, "# chart: column"));
    CHECK(test::contains(text, "# here\n"));
    CHECK(test::contains(text, ",lost,nan,nan,nan,nan,100,0,no,no,"));
    CHECK(test::contains(text, ",ok,10,8,16,100,1000,5,yes,yes,"));
}

TEST_CASE("a result that is right once and wrong while the clock runs gets no time") {
    FakeRunner runner;
    runner.failsWhenTimed = true;
    const Row row = measured(runner);
    CHECK(row.verdict == "overflow");
    CHECK(row.runs == 0);
    CHECK(std::isnan(row.milliseconds.median));
}

TEST_CASE("each knob is swept with the other as usual, and the usual setting comes once") {
    const std::vector<Setting> settings = settingsToTry(FakeRunner{}, false);
    REQUIRE(settings.size() == 1 + 6 + 3);
    CHECK(settings[0].curve == "both");
    CHECK(settings[0].knobs == Knobs{1, 4});
    for (std::size_t k = 1; k < settings.size(); ++k) {
        CAPTURE(k);
        CHECK_FALSE(settings[k].knobs == Knobs{1, 4});
        CHECK(settings[k].curve == (k < 7 ? "dt" : "rounds"));
        CHECK((k < 7 ? settings[k].knobs.passes == 4 : settings[k].knobs.stepsAFrame == 1));
    }
    CHECK(settingsToTry(FakeRunner{}, true).size() < settings.size());
}

TEST_CASE("a run has whole steps, and looks at the end of every frame or longer step") {
    Scene scene;
    scene.dt = 0.1f;
    const auto looksOf = [&](double stepsAFrame) {
        std::vector<double> looks;
        int steps = 0;
        const double simulated = forEachStep(
            scene, {stepsAFrame, 0}, 0.4, [&] { ++steps; },
            [&](double time) { return looks.push_back(time), true; });
        CHECK(steps == Approx(4 * stepsAFrame));
        CHECK(simulated == Approx(0.4));
        return looks.size();
    };
    CHECK(looksOf(1) == 4);
    CHECK(looksOf(8) == 4);
    CHECK(looksOf(0.5) == 2);
    int steps = 0;
    forEachStep(
        scene, {1, 0}, 0.4, [&] { ++steps; }, [](double) { return false; });
    CHECK(steps == 1);
}

TEST_CASE("a row comes back from its line, commas, missing values and all") {
    Row row = exampleRow();
    const std::optional<Row> same = rowOf(lineOf(row));
    REQUIRE(same);
    CHECK(lineOf(*same) == lineOf(row));
    CHECK(same->label == row.label);
    CHECK(same->knobs == row.knobs);
    row.verdict = "not finite";
    row.error = row.pairVisits = nothing;
    row.milliseconds = {};
    const std::optional<Row> failed = rowOf(lineOf(row));
    REQUIRE(failed);
    CHECK(std::isnan(failed->error));
    CHECK_FALSE(failed->isGood());
    CHECK_FALSE(rowOf("column,fake"));
    CHECK_FALSE(rowOf(""));
}

TEST_CASE("a chart that was stopped goes on behind its last whole row") {
    const Folder folder;
    const std::string head = "# commit 1\n";
    Row second = exampleRow();
    second.knobs.passes = 8;
    {
        WorkingFile file(folder.part, head);
        CHECK(file.rows().empty());
        file.append(exampleRow());
        // As after kill -9: nothing was closed, and all is there.
        CHECK(contentsOf(folder.part) == head + lineOf(exampleRow()) + "\n");
        file.append(second);
    }
    const std::string whole = contentsOf(folder.part);
    write(folder.part, whole.substr(0, whole.size() - 9));  // torn
    WorkingFile again(folder.part, head);
    CHECK(again.rows().size() == 1);
    CHECK(again.find(exampleRow()));
    CHECK_FALSE(again.find(second));
    again.append(second);
    CHECK(contentsOf(folder.part) == whole);
    // A row is whole only with its line's end: what lacks it may lack more.
    write(folder.part, whole.substr(0, whole.size() - 1));
    CHECK(WorkingFile(folder.part, head).rows().size() == 1);
    again.remove();
    CHECK_FALSE(std::filesystem::exists(folder.part));
}

TEST_CASE("what another run has left is not mixed in") {
    const Folder folder;
    WorkingFile(folder.part, "# commit 1\n").append(exampleRow());
    WorkingFile file(folder.part, "# commit 2\n");
    CHECK(file.replacedAnother());
    CHECK(file.rows().empty());
    CHECK(contentsOf(folder.part) == "# commit 2\n");
}

TEST_CASE(
    "the plan is one point of a chart, within the scene's tolerance, below the original loop") {
    const stability::Question& column = stability::question("column");
    const Runners runners = ourRunners(Device::cpu);
    const auto rowOf = [&](const std::string& method) {
        const auto runner = std::find_if(runners.begin(), runners.end(),
                                         [&](const auto& r) { return r->method() == method; });
        REQUIRE(runner != runners.end());
        const std::vector<Setting> settings = settingsToTry(**runner, true);
        if (method == "plan") CHECK(settings.size() == 1);
        return measuredRow(column, **runner, settings.front(), {.quick = true}).value();
    };
    const Row plan = rowOf("plan"), original = rowOf("mass-split");
    CHECK(plan.label == "plan");
    CHECK(original.label == "original loop");
    CHECK(plan.error < column.tolerance);
    CHECK(original.error > 2 * column.tolerance);
    CHECK(plan.pairVisits > 0);
}

TEST_CASE("unknown scenes and methods are refused with the list") {
    Asked asked;
    asked.scenes = {"six_squared"};
    const std::string scene = test::messageOf<InputError>([&] { runChart(asked); });
    CHECK(test::contains(scene, "scene 'six_squared'"));
    CHECK(test::contains(scene, "deep_pile"));
    asked.scenes = {"666"};
    asked.methods = {"wram"};
    const std::string method = test::messageOf<InputError>([&] { runChart(asked); });
    CHECK(test::contains(method, "method 'wram': known methods are racy, atomic, jacobi"));
    CHECK(test::contains(method, "--peers"));
    asked.methods = {};
    asked.out = "/no/such/folder";
    CHECK(test::messageOf<InputError>([&] { runChart(asked); }) ==
          "--out /no/such/folder: is not a folder");
}
