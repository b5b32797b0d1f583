// Chapter 08: two matrices carry a point of the world into the picture.
#pragma once

#include "common/camera.h"
//@starter #include "common/hole.cuh"

namespace ballpit {

/// World to eye space, in which the eye is at the origin and looks along -z. OpenGL stores a matrix
/// column by column: the first four numbers are what the x axis becomes, the last four where the
/// world's origin goes.
inline Matrix4 lookAt(const Camera& camera) {
    const auto [right, up, forward] = axesOf(camera);
    const Vec3 eye = camera.eye;
    //@hole camera.look_at lines=6 "The camera's axes as rows, and the way from the eye"
    //@starter TODO_HOLE("camera.look_at");
    //@starter return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -eye.x, -eye.y, -eye.z, 1};
    return {right.x,          up.x,          -forward.x,        0.0f,  //
            right.y,          up.y,          -forward.y,        0.0f,  //
            right.z,          up.z,          -forward.z,        0.0f,  //
            -dot(right, eye), -dot(up, eye), dot(forward, eye), 1.0f};
    //@end
}

/// Eye space to clip space. OpenGL divides what comes out by its fourth number; what is then within
/// -1 and 1 is in the picture. `aspect` is width / height; near and far are distances in m.
inline Matrix4 perspective(const Camera& camera, float aspect, float nearDistance,
                           float farDistance) {
    const float tangent = halfHeightTangent(camera);  // of half the vertical field of view
    Matrix4 matrix{};
    //@hole camera.perspective lines=6 "Divide by the distance; near becomes -1, far 1"
    //@starter TODO_HOLE("camera.perspective");
    //@starter matrix[0] = matrix[5] = matrix[10] = matrix[15] = 1.0f / farDistance;
    matrix[0] = 1.0f / (tangent * aspect);
    matrix[5] = 1.0f / tangent;
    matrix[10] = (farDistance + nearDistance) / (nearDistance - farDistance);
    matrix[11] = -1.0f;  // the fourth number becomes -z: the distance before the eye
    matrix[14] = 2.0f * farDistance * nearDistance / (nearDistance - farDistance);
    //@end
    return matrix;
}

}  // namespace ballpit
