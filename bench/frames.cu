// Steps, hands the positions to OpenGL, draws, waits; what each of them takes.
#include "bench/frames.h"

#include <GL/glew.h>

#include <cstdio>

#include "08_sphere_rendering/sphere_renderer.h"
#include "10_full_system/physics_simulator.cuh"
#include "common/offscreen_context.h"
#include "common/shared_vertices.h"
#include "common/timing.h"
#include "common/whole_file.h"

namespace ballpit {

namespace {

constexpr int warmUpFrames = 5;

/// Medians, in ms.
struct FrameTimes {
    double step = 0.0, draw = 0.0, frame = 0.0;
    std::string way;
};

/// The scene's balls, in a simulator and in front of a camera.
struct Studio {
    Studio(const Scene& scene, Device device)
        : simulator(settingsFor(scene, device)), renderer(scene.bounds, 1920, 1080) {
        simulator.bodies().upload(scene.spheres);
        renderer.style.shape = BallShape::points;
        buffer = renderer.positionBuffer(scene.spheres.count());
        renderer.setColors(scene.spheres.colors);
    }
    PhysicsSimulator simulator;
    SphereRenderer renderer;
    unsigned buffer = 0;
};

FrameTimes timeFrames(Studio& studio, bool mayShare, int repeats) {
    RigidBodySystem& bodies = studio.simulator.bodies();
    SharedVertices vertices(bodies, studio.buffer, mayShare);
    std::vector<double> steps, draws, frames;
    for (int frame = -warmUpFrames; frame < repeats; ++frame) {
        const double start = milliseconds();
        studio.simulator.step();
        const double stepped = milliseconds();
        vertices.update();
        studio.renderer.drawFromBuffer(bodies.largestRadius());
        glFinish();
        const double drawn = milliseconds();
        if (frame < 0) continue;
        steps.push_back(stepped - start);
        draws.push_back(drawn - stepped);
        frames.push_back(drawn - start);
    }
    return {median(steps), median(draws), median(frames),
            vertices.isDirect() ? "on the GPU" : "through main memory"};
}

}  // namespace

void runFramesBench(const FramesPlan& plan) {
    if (!plan.csv.empty()) requireWritable(plan.csv);
    const bool onCuda = plan.device == Device::cuda;
    const std::vector<int> counts = !plan.counts.empty() ? plan.counts
                                    : onCuda             ? std::vector{16384, 131072, 1000000}
                                                         : std::vector{1000, 10000, 100000};
    const OffscreenContext context;
    const auto* card = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    std::string table = "balls,positions,step ms,draw ms,frames a second\n";
    std::printf("physics: %s; OpenGL: %s; 1920x1080, medians of %d frames\n",
                describe(plan.device).c_str(), card, plan.repeats);
    std::printf("%9s  %-20s %10s %10s %10s\n", "balls", "positions", "step ms", "draw ms",
                "frames/s");
    for (const int count : counts) {
        Studio studio(makeGravityFall(count, 1), plan.device);
        for (const bool mayShare : {true, false}) {
            const FrameTimes t = timeFrames(studio, mayShare, plan.repeats);
            const double rate = 1e3 / t.frame;
            std::printf("%9d  %-20s %10.3f %10.3f %10.1f\n", count, t.way.c_str(), t.step, t.draw,
                        rate);
            std::fflush(stdout);
            table += std::to_string(count) + "," + t.way + "," + std::to_string(t.step) + "," +
                     std::to_string(t.draw) + "," + std::to_string(rate) + "\n";
            if (t.way != "on the GPU") break;  // the second time would be the same
        }
    }
    if (plan.csv.empty()) return;
    writeWhole(plan.csv, "# ./ballpit bench --frames; physics: " + describe(plan.device) +
                             "; OpenGL: " + card + "; medians of " + std::to_string(plan.repeats) +
                             " frames\n" + table);
}

}  // namespace ballpit
