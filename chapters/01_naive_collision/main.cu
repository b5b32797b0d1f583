// Chapter 01's executable: balls scattered on a table; those that touch another are red.
#include "01_naive_collision/naive_collision.cuh"

#include "common/film.h"
#include "common/findings.h"
#include "common/metrics.h"
#include "common/random.h"
#include "common/timing.h"

using namespace ballpit;

namespace {

int run(const Options& options) {
    const int count = options.count;
    // 5 m^2 of table for each ball, so that more balls are not more crowded. All centres at y = 0.
    const float half = std::sqrt(5.0f * static_cast<float>(count)) / 2;
    Random random(options.seed);
    Spheres spheres;
    std::vector<Vec4> balls;
    for (int k = 0; k < count; ++k) {
        const Vec3 place = random.uniformIn({{-half, 0, -half}, {half, 0, half}});
        spheres.add(place, {}, random.uniform(0.3f, 0.8f), 1.0f, 1.0f);
        balls.push_back(withW(place, spheres.radii.back()));
    }
    DeviceBuffer<Vec4> positions(options.device, balls.size(), "positions");
    DeviceBuffer<Pair> pairs(options.device, 0, "pairs");
    DeviceBuffer<std::uint32_t> found(options.device, 1, "found");
    positions.upload(balls);
    const auto search = [&] {
        found.fill(0);
        launchFindPairsNaive(options.device, count, positions.view(), pairs.view(), found.view());
        return found.download()[0];
    };
    pairs.resize(search());  // a full list says how long it must be
    std::vector<Pair> list = pairs.download(search());
    std::sort(list.begin(), list.end());  // threads append in any order
    std::vector<std::uint32_t> touching;
    for (const auto [a, b] : list) touching.insert(touching.end(), {a, b});
    for (const std::uint32_t ball : touching) spheres.colors.at(ball) = {0.86f, 0.15f, 0.13f};

    Findings findings("01 naive_collision");
    findings.add("count", std::int64_t{count});
    findings.add("comparisons", std::int64_t{count} * (count - 1) / 2);
    findings.add("touching pairs", static_cast<std::int64_t>(list.size()));
    findings.add("state hash", hashText(wordHash(touching)));
    findings.list("positions", spheres.positions);
    findings.list("radii", std::vector<double>(spheres.radii.begin(), spheres.radii.end()));
    findings.list("pairs", touching);
    if (options.time) findings.add("milliseconds", medianMilliseconds(options.device, 7, search));
    findings.print(options.json);
    showSpheres(options, {{-half, -0.8f, -half}, {half, 0.4f * half, half}}, spheres);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return runChapter(argc, argv, "Which balls touch?", {.count = 1000}, run);
}
