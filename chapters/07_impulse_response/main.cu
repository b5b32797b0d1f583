// Chapter 07's executable: the same contacts, resolved by each version of the response.
#include "07_impulse_response/examples.cuh"
#include "07_impulse_response/racy_response.cuh"
#include "chapters/07_impulse_response/two_boxes.cuh"
#include "common/findings.h"
#include "common/metrics.h"
#include "common/timing.h"

using namespace ballpit;

/// What a version makes of the scenes; of `many` twice, on a CPU with the last thread first the
/// second time. Balls of `many` that then move otherwise by more than rounding turn red.
static void tell(Findings& findings, const std::string& version, const Options& options,
                 Response&& response, Example& many) {
    const auto resolve = [&](const Example& example, LaunchOrder order = LaunchOrder::forward) {
        return resolved(options.device, example, response, order);
    };
    const Spheres pocket = resolve(pocketOfThree()), once = resolve(many);
    const Spheres again = resolve(many, LaunchOrder::reversed);
    findings.list(version + " two balls", resolve(twoBalls()).velocities);
    findings.list(version + " pocket", pocket.velocities);
    findings.add(version + ": row of three, m/s", speedsAlongX(resolve(rowOf({1, 0, -2}))));
    findings.add(version + ": energy of the pocket, J", kineticEnergy(pocket));
    findings.add(version + ": momentum gone, kg m/s", momentumBetween(many.balls, once));
    findings.add(version + ": state hash", hashText(stateHash(once)));
    findings.add(version + ": once more", hashText(stateHash(again)));
    for (std::size_t k = 0; k < once.count(); ++k)
        if (length(once.velocities[k] - again.velocities[k]) > 1e-3f)
            many.balls.colors[k] = {0.9f, 0.1f, 0.1f};
    if (!options.time || version == "in warps") return;  // that one is staged, on one thread
    OneRound bodies(options.device, many.balls, many.pairs);
    findings.add(version == "gathered" ? "milliseconds" : version + ": milliseconds",
                 medianMilliseconds(options.device, 31, [&] { response.resolve(bodies.round()); }));
}

static int run(const Options& o) {
    const Scene scene = makeUniform(o.count, o.seed);
    Example many{scene.spheres, findPairsOnHost(scene.spheres)};
    many.balls.colors.assign(many.balls.count(), {0.7f, 0.7f, 0.75f});
    const std::size_t balls = many.balls.count() + 4, pairs = many.pairs.size() + 4;
    Findings findings("07 impulse_response: one round");
    findings.add("count", std::int64_t{o.count});
    findings.list("two balls positions", twoBalls().balls.positions);
    findings.list("two balls before", twoBalls().balls.velocities);
    findings.list("pocket positions", pocketOfThree().balls.positions);
    findings.list("pocket before", pocketOfThree().balls.velocities);
    tell(findings, "in place", o, RacyResponse(o.device), many);
    tell(findings, "in warps", o, RacyResponse(o.device, true), many);
    tell(findings, "atomic", o, AtomicResponse(o.device), many);
    tell(findings, "gathered", o, ImpulseResponse(o.device, balls, pairs), many);
    findings.print(o.json);
    o.isFilmed() ? showTwoBoxes(o) : showSpheres(o, scene.bounds, many.balls);
    return 0;
}

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Contacts, resolved in four ways", {.count = 1000}, run);
}
