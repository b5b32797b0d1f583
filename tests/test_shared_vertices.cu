// OpenGL's buffer holds what the bodies say, whichever way it came.
#include <GL/glew.h>

#include "10_full_system/physics_simulator.cuh"
#include "common/offscreen_context.h"
#include "common/scene.h"
#include "common/shared_vertices.h"
#include "tests/catch.h"
#include "tests/support.h"

using namespace ballpit;

namespace {

struct Buffer {
    explicit Buffer(std::size_t count) : count(count) {
        glGenBuffers(1, &name);
        glBindBuffer(GL_ARRAY_BUFFER, name);
        const std::vector<Vec4> nothing(count, Vec4{-1, -1, -1, -1});
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * sizeof(Vec4)), nothing.data(),
                     GL_DYNAMIC_DRAW);
    }
    ~Buffer() { glDeleteBuffers(1, &name); }
    Buffer(const Buffer&) = delete;

    std::vector<Vec4> content() const {
        std::vector<Vec4> vertices(count);
        glBindBuffer(GL_ARRAY_BUFFER, name);
        glGetBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(Vec4)),
                           vertices.data());
        return vertices;
    }

    GLuint name = 0;
    std::size_t count;
};

/// How many vertices are not their body's position and radius.
std::size_t differences(const Buffer& buffer, RigidBodySystem& bodies) {
    const std::vector<Vec3> positions = bodies.positions.download();
    const std::vector<float> radii = bodies.radii.download();
    const std::vector<Vec4> vertices = buffer.content();
    std::size_t count = 0;
    for (std::size_t k = 0; k < vertices.size(); ++k)
        count += !(xyz(vertices[k]) == positions[k] && vertices[k].w == radii[k]);
    return count;
}

}  // namespace

TEST_CASE("OpenGL's buffer gets every body's position and radius, in body order", "[window]") {
    const OffscreenContext context;
    for (const Device device : test::devices())
        for (const bool mayShare : {true, false})
            for (const int count : {1, 255, 257, 5000}) {
                CAPTURE(name(device), mayShare, count);
                Scene scene = makeGravityFall(count, 7);
                PhysicsSimulator simulator(settingsFor(scene, device));
                simulator.bodies().upload(scene.spheres);
                Buffer buffer(simulator.bodies().count());
                SharedVertices vertices(simulator.bodies(), buffer.name, mayShare);
                simulator.step();  // from now on the order in memory is another one
                vertices.update();
                CHECK(differences(buffer, simulator.bodies()) == 0);
                simulator.step();
                CHECK(differences(buffer, simulator.bodies()) > 0);
                vertices.update();
                CHECK(differences(buffer, simulator.bodies()) == 0);
            }
}

TEST_CASE("Who cannot share a buffer says why", "[window]") {
    const OffscreenContext context;
    RigidBodySystem onCpu(Device::cpu, 3);
    Buffer buffer(3);
    const SharedVertices vertices(onCpu, buffer.name);
    CHECK_FALSE(vertices.isDirect());
    CHECK(vertices.notice().empty());
    if (!cudaUsable()) return;
    RigidBodySystem onCuda(Device::cuda, 3);
    const SharedVertices shared(onCuda, buffer.name);
    WARN("CUDA and OpenGL: " << (shared.isDirect() ? "shared" : shared.notice()));
    CHECK(shared.isDirect() == shared.notice().empty());
}
