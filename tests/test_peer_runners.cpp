// Bullet and ODE as runners of the chart.
#include <cmath>
#include <set>

#include "chart/peers/peer_runner.h"
#include "stability/scenes.h"
#include "tests/support.h"

using namespace ballpit;
using namespace ballpit::chart;
using namespace ballpit::stability;

namespace {

Runner& runnerOf(Peers& peers, const std::string& method) {
    for (const auto& runner : peers.runners)
        if (runner->method() == method) return *runner;
    throw std::runtime_error("no runner " + method);
}

}  // namespace

TEST_CASE("the peers' curves have names of their own, say engine and precision, and run 666") {
    const Peers peers = peerRunners();
    CHECK(peers.missing.empty());
    std::set<std::string> methods;
    for (const auto& runner : peers.runners) {
        CAPTURE(runner->method());
        CHECK(methods.insert(runner->method()).second);
        CHECK(test::contains(runner->engine(), runner->method().substr(0, 3)));
        CHECK((test::contains(runner->engine(), ", float") ||
               test::contains(runner->engine(), ", double")));
        CHECK(test::contains(runner->pointName(runner->usual()), "default"));
        CHECK(runner->pointName({2, runner->usual().passes}).empty());
        CHECK(runner->canRun(question("bounce")));
        CHECK_FALSE(runner->canRun(question("two_bodies")));
        CHECK(runner->canRun(question("666")) == (runner->method() != "ode-dantzig"));
    }
    CHECK(methods == std::set<std::string>{"bullet", "bullet-as-packaged", "ode", "ode-dantzig"});
}

TEST_CASE("a peer's run for the error counts visits and takes no time, the other the reverse") {
    Peers peers = peerRunners();
    const std::string method = GENERATE("bullet", "ode");
    Runner& runner = runnerOf(peers, method);
    const Scene scene = makeSixCubed(0, 1);
    const Knobs knobs{2, 5};
    const auto meter = question("666").meter(scene, runner.movingStep(scene, knobs));
    const RunResult error = runner.run(scene, knobs, 0.5, meter.get());
    CHECK(error.verdict == Verdict::ok);
    CHECK(meter->verdict() == Verdict::ok);
    CHECK(meter->error() > 0);
    CHECK(error.cost.milliseconds == 0);
    CHECK(error.cost.simulatedSeconds == Approx(0.5));
    CHECK(error.cost.pairVisits > 0);
    CHECK(std::fmod(error.cost.pairVisits, 5) == 0);

    const RunResult time = runner.run(scene, knobs, 0.5, nullptr);
    CHECK(time.cost.milliseconds > 0);
    CHECK(time.cost.simulatedSeconds == error.cost.simulatedSeconds);
    CHECK(time.cost.pairVisits == 0);
}

TEST_CASE("finer steps bring a peer nearer to the truth") {
    Peers peers = peerRunners();
    const std::string method = GENERATE("bullet", "ode");
    CAPTURE(method);
    Runner& runner = runnerOf(peers, method);
    const Scene scene = makeSixCubed(0, 1);
    const auto errorWith = [&](double stepsAFrame) {
        const Knobs knobs{stepsAFrame, runner.usual().passes};
        const auto meter = question("666").meter(scene, runner.movingStep(scene, knobs));
        runner.run(scene, knobs, 2, meter.get());
        return meter->error();
    };
    CHECK(errorWith(4) < 0.5 * errorWith(1));
}

TEST_CASE("a run that a peer's solver breaks off has no verdict of ok") {
    Peers peers = peerRunners();
    const Scene scene = makeColumn(10, 0);
    CHECK(runnerOf(peers, "ode-dantzig").run(scene, {1, 0}, 1, nullptr).verdict ==
          Verdict::inaccurate);
    CHECK(runnerOf(peers, "ode").run(makeNotFinite(), {1, 20}, 1, nullptr).verdict ==
          Verdict::notFinite);
}
