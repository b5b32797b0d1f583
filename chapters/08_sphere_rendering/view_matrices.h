// Chapter 08: two matrices carry a point of the world into the picture.
#pragma once

#include "common/camera.h"
#include "common/hole.cuh"

namespace ballpit {

/// World to eye space, in which the eye is at the origin and looks along -z. OpenGL stores a matrix
/// column by column: the first four numbers are what the x axis becomes, the last four where the
/// world's origin goes.
inline Matrix4 lookAt(const Camera& camera) {
    const auto [right, up, forward] = axesOf(camera);
    const Vec3 eye = camera.eye;
    // ---- hole camera.look_at (about 6 lines): The camera's axes as rows, and the way from the eye
    TODO_HOLE("camera.look_at");
    return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -eye.x, -eye.y, -eye.z, 1};
    // ---- end of camera.look_at
}

/// Eye space to clip space. OpenGL divides what comes out by its fourth number; what is then within
/// -1 and 1 is in the picture. `aspect` is width / height; near and far are distances in m.
inline Matrix4 perspective(const Camera& camera, float aspect, float nearDistance,
                           float farDistance) {
    const float tangent = halfHeightTangent(camera);  // of half the vertical field of view
    Matrix4 matrix{};
    // ---- hole camera.perspective (about 6 lines): Divide by the distance; near becomes -1, far 1
    TODO_HOLE("camera.perspective");
    matrix[0] = matrix[5] = matrix[10] = matrix[15] = 1.0f / farDistance;
    // ---- end of camera.perspective
    return matrix;
}

}  // namespace ballpit
