// Chapter 08: a ball as OpenGL's utility library draws it, gluSphere: a net of flat faces.
#pragma once

#include "common/hole.cuh"
#include "common/vec3.cuh"

#include <GL/glew.h>

#include <GL/glu.h>

#include <stdexcept>

namespace ballpit {

/// A sphere of radius 1 with `slices` faces around its axis and `stacks` from pole to pole,
/// compiled once into a display list: from then on the driver has it, and drawing it is one call.
/// Needs a current OpenGL context as long as it lives.
class Sphere {
public:
    explicit Sphere(int slices = 32, int stacks = 32) : list_(glGenLists(1)) {
        if (list_ == 0) throw std::runtime_error("OpenGL gives no display list: is it current?");
        compile(slices, stacks);
    }
    ~Sphere() { glDeleteLists(list_, 1); }
    Sphere(const Sphere&) = delete;
    Sphere& operator=(const Sphere&) = delete;

    /// Draws it around the origin of the current matrix, with this radius in m.
    void draw(float radius) const {
        // ---- hole net.draw (about 4 lines): Scale the unit sphere, call the list, leave no trace
        TODO_HOLE("net.draw");
        // ---- end of net.draw
    }

private:
    void compile(int slices, int stacks) const {
        GLUquadric* quadric = gluNewQuadric();
        // ---- hole net.compile (about 3 lines): Record a sphere of radius 1 in the list
        TODO_HOLE("net.compile");
        glNewList(list_, GL_COMPILE);
        glEndList();
        // ---- end of net.compile
        gluDeleteQuadric(quadric);
    }

    unsigned list_;
};

/// One ball of the world: its place and colour, and the sphere that is drawn there.
inline void drawBall(const Sphere& sphere, Vec3 position, float radius, Vec3 color) {
    // ---- hole net.place (about 5 lines): Move the origin to the ball, choose the colour, draw
    TODO_HOLE("net.place");
    // ---- end of net.place
}

/// From here on a pixel keeps what is nearest to the eye, in whatever order things are drawn.
inline void useDepthTest() {
    // ---- hole depth.test (about 3 lines): Compare depths, keep the smaller, and write it
    TODO_HOLE("depth.test");
    // ---- end of depth.test
}

}  // namespace ballpit
