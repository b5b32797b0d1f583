// Runs scenes with other engines, for the error or for the time.
#include "chart/peers/peer_runner.h"

#include <algorithm>
#include <limits>

#include "common/error.h"
#include "common/timing.h"

namespace ballpit::chart {

namespace {

class PeerRunner : public Runner {
public:
    explicit PeerRunner(PeerMethod method) : method_(std::move(method)) {}

    std::string engine() const override { return method_.engine; }
    std::string method() const override { return method_.method; }
    std::string passesName() const override { return hasIterations() ? "iterations" : ""; }
    Knobs usual() const override { return {1, method_.usualIterations}; }
    std::string pointName(const Knobs& knobs) const override {
        return knobs == usual() ? method_.method + ", default" : "";
    }
    std::vector<int> passesToTry() const override { return method_.iterations; }
    bool canRun(const stability::Question& question) const override {
        return std::ranges::find(method_.scenes, question.scene) != method_.scenes.end();
    }

    RunResult run(const Scene& scene, const Knobs& knobs, double seconds, Meter* meter) override {
        const auto peer = world(scene, knobs);
        try {
            return meter ? metered(*peer, scene, knobs, seconds, *meter)
                         : timed(*peer, scene, knobs, seconds);
        } catch (const NotFiniteError&) {
            return {.verdict = Verdict::notFinite};
        } catch (const SolverGaveUp&) {
            return {.verdict = Verdict::inaccurate};
        }
    }

private:
    bool hasIterations() const { return method_.usualIterations > 0; }

    std::unique_ptr<Peer> world(const Scene& scene, const Knobs& knobs) const {
        return method_.make(scene, {static_cast<float>(scene.dt / knobs.stepsAFrame),
                                    hasIterations() ? knobs.passes : 1});
    }

    RunResult metered(Peer& peer, const Scene& scene, const Knobs& knobs, double seconds,
                      Meter& meter) const {
        RunResult result;
        double visits = 0;
        const auto step = [&] {
            peer.step();
            visits += static_cast<double>(peer.contacts()) * knobs.passes;
        };
        const auto look = [&](double time) {
            meter.add(peer.spheres(), time);
            return !meter.hasFailed();
        };
        result.cost.simulatedSeconds = forEachStep(scene, knobs, seconds, step, look);
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        result.cost.pairVisits = hasIterations() ? visits : unknown;
        return result;
    }

    RunResult timed(Peer& peer, const Scene& scene, const Knobs& knobs, double seconds) const {
        RunResult result;
        world(scene, knobs)->step();  // loads the library's code
        const double start = milliseconds();
        result.cost.simulatedSeconds = forEachStep(
            scene, knobs, seconds, [&] { peer.step(); }, [](double) { return true; });
        result.cost.milliseconds = milliseconds() - start;
        return result;
    }

    PeerMethod method_;
};

}  // namespace

const std::vector<std::string> peerScenes{"bounce", "six_cubed", "six_cubed_elastic", "column",
                                          "deep_pile"};

void addMethod(Peers& peers, PeerMethod method) {
    peers.runners.push_back(std::make_unique<PeerRunner>(std::move(method)));
}

Peers peerRunners() {
    Peers peers;
    addBullet(peers);
    addOde(peers);
    return peers;
}

}  // namespace ballpit::chart
