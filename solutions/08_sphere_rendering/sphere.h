// Chapter 08: a ball as OpenGL's utility library draws it, gluSphere: a net of flat faces.
#pragma once

//@starter #include "common/hole.cuh"
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
        //@hole net.draw lines=4 "Scale the unit sphere, call the list, leave no trace"
        //@starter TODO_HOLE("net.draw");
        glPushMatrix();
        glScalef(radius, radius, radius);
        glCallList(list_);
        glPopMatrix();
        //@end
    }

private:
    void compile(int slices, int stacks) const {
        GLUquadric* quadric = gluNewQuadric();
        //@hole net.compile lines=3 "Record a sphere of radius 1 in the list"
        //@starter TODO_HOLE("net.compile");
        //@starter glNewList(list_, GL_COMPILE);
        //@starter glEndList();
        glNewList(list_, GL_COMPILE);
        gluSphere(quadric, 1.0, slices, stacks);
        glEndList();
        //@end
        gluDeleteQuadric(quadric);
    }

    unsigned list_;
};

/// One ball of the world: its place and colour, and the sphere that is drawn there.
inline void drawBall(const Sphere& sphere, Vec3 position, float radius, Vec3 color) {
    //@hole net.place lines=5 "Move the origin to the ball, choose the colour, draw"
    //@starter TODO_HOLE("net.place");
    glPushMatrix();
    glTranslatef(position.x, position.y, position.z);
    glColor3f(color.x, color.y, color.z);
    sphere.draw(radius);
    glPopMatrix();
    //@end
}

/// From here on a pixel keeps what is nearest to the eye, in whatever order things are drawn.
inline void useDepthTest() {
    //@hole depth.test lines=3 "Compare depths, keep the smaller, and write it"
    //@starter TODO_HOLE("depth.test");
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    //@end
}

}  // namespace ballpit
