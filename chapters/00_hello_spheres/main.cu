// Chapter 00's executable: a kernel places balls in spirals; a hash and a picture show that it ran.
#include "00_hello_spheres/hello_spheres.cuh"

#include "common/error.h"
#include "common/film.h"
#include "common/findings.h"
#include "common/launch.cuh"
#include "common/metrics.h"
#include "common/motion.h"
#include "common/timing.h"

using namespace ballpit;

namespace {

constexpr Bounds world{{-4.8f, 0, -4.8f}, {4.8f, 3, 4.8f}};

int run(const Options& options) {
    const auto count = static_cast<std::size_t>(options.count);
    //@show launch
    DeviceBuffer<Vec4> positions(options.device, count, "positions");
    DeviceBuffer<Vec3> colors(options.device, count, "colors");
    const Hill hill = makeHill(options.count, options.seed);
    const auto placeAll = [&] {
        launch<placeBall>(options.device, options.count, hill, positions.view(), colors.view());
    };
    placeAll();
    const std::vector<Vec4> placed = positions.download();
    const std::vector<Vec3> colored = colors.download();
    //@end
    Spheres spheres;
    for (std::size_t k = 0; k < count; ++k)
        spheres.add(xyz(placed[k]), {}, placed[k].w, 1.0f, 1.0f, colored[k]);

    Findings findings("00 hello_spheres");
    findings.add("count", std::int64_t{options.count});
    findings.add("radius of the first ball", placed[0].w);
    findings.add("state hash", hashText(stateHash(spheres)));
    if (options.json) {
        findings.list("positions", spheres.positions);
        findings.list("colors", spheres.colors);
    }
    if (options.time)
        findings.add("milliseconds", medianMilliseconds(options.device, 31, placeAll));
    findings.print(options.json);
    // In the film the balls appear in the order of their threads' numbers.
    const std::vector<float> radii = spheres.radii;
    const auto appear = [&](Spheres& shown, float share) { showFirst(shown, radii, share); };
    showMotion(options, world, spheres, appear, 1.0f);
    return exitOk;
}

}  // namespace

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Balls on a hill, in spirals: does the tool chain work?",
                      {.count = 1000, .seed = 0}, run);
}
