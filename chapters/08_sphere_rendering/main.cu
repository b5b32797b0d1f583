// Chapter 08's executable: the same balls as nets of faces and as exact spheres.
#include <iostream>

#include "chapters/08_sphere_rendering/growing_nets.h"
#include "chapters/08_sphere_rendering/showcase.h"
#include "common/error.h"
#include "common/scene.h"

using namespace ballpit;

static int run(const Options& o) {
    const Scene scene = makeGravityFall(o.count, o.seed);
    const OrbitCamera orbit = orbitOf(frameWorld(scene.bounds));
    Findings findings("08 sphere_rendering");
    findings.add("count", std::int64_t{o.count});
    tellDetail(findings, scene.spheres, orbit.camera(), o.height);
    listForFigures(findings);
    if (o.time) tellTimes(findings, o, scene);
    findings.print(o.json);
    if (!o.png.empty()) {
        writePng(o.png, sideBySide(o));
        std::cerr << "saved " << o.png << '\n';
    }
    Options film = o;
    film.png.clear();
    if (film.isFilmed()) showGrowingNets(film, fewBallsWorld, fewBalls());
    return exitOk;
}

int main(int argc, char** argv) {
    return runChapter(argc, argv,
                      "Balls as GLU spheres and as impostors: equal pictures, unequal times. --png "
                      "draws both and their difference",
                      {.count = 500, .frames = 360, .timedCount = 200}, run);
}
