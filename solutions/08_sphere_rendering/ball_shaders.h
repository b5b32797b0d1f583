// The shaders of balls, around the functions of shading.h. All work in eye space: the eye is at 0
// and looks along -z. GLSL 1.20, so that OpenGL 2.1 is enough.
#pragma once

#include "08_sphere_rendering/shading.h"

#include <string>

namespace ballpit {

/// Where a ball lies, and the rectangle that just covers its silhouette: an ellipse, off the
/// picture's centre.
inline constexpr const char* ballDeclarations = R"(#version 120
uniform vec2 tangents;  // of half the field of view, across and along
uniform vec2 viewport;  // in pixels
attribute vec4 ball;    // centre and radius
attribute vec3 color;
varying vec3 center;
varying float radius;
varying vec3 ballColor;
vec2 lower, upper;  // the rectangle, in -1..1

// Seen from above, the two tangents from the eye to a circle at (x, depth) meet the plane at
// depth 1 here.
vec2 silhouette(float x, float depth, float radius) {
    float root = radius * sqrt(x * x + depth * depth - radius * radius);
    return vec2(x * depth - root, x * depth + root) / (depth * depth - radius * radius);
}

void placeBall() {
    center = (gl_ModelViewMatrix * vec4(ball.xyz, 1.0)).xyz;
    radius = ball.w;
    ballColor = color;
    lower = vec2(-1.0);  // right for a ball that the eye's plane cuts
    upper = vec2(1.0);
    if (-center.z > 1.001 * radius) {
        vec2 across = silhouette(center.x, -center.z, radius);
        vec2 along = silhouette(center.y, -center.z, radius);
        vec2 softEdge = 2.0 / viewport;
        lower = vec2(across.x, along.x) / tangents - softEdge;
        upper = vec2(across.y, along.y) / tangents + softEdge;
    }
}
)";

inline std::string quadVertexShader() {
    return std::string(ballDeclarations) + R"(
attribute vec2 corner;  // of the square, each 0 or 1
void main() {
    placeBall();
    if (center.z > radius) lower = upper = vec2(2.0);  // behind the eye
    gl_Position = vec4(mix(lower, upper, corner), 0.0, 1.0);
}
)";
}

/// A point is a square around one vertex. OpenGL drops a point whose centre is outside the frame,
/// so the point covers only what of the ball's rectangle is inside.
inline std::string pointVertexShader() {
    return std::string(ballDeclarations) + R"(
void main() {
    placeBall();
    float pixel = 2.0 * tangents.y / viewport.y * -center.z;  // m, at the ball's depth
    if (0.75 * pixel > radius) {  // no ball falls between the pixels
        radius = 0.75 * pixel;
        placeBall();
        radius = 0.75 * pixel;
    }
    vec2 from = max(lower, -1.0), to = min(upper, 1.0);
    // NaN is not less than anything.
    bool isSane = ball.w > 0.0 && dot(ball.xyz, ball.xyz) < 1e30;
    if (isSane && center.z < 0.0 && from.x < to.x && from.y < to.y) {
        vec2 size = 0.5 * (to - from) * viewport;
        gl_PointSize = max(size.x, size.y);
        gl_Position = vec4(0.5 * (from + to), 0.0, 1.0);
    } else {
        gl_PointSize = 1.0;
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside
    }
}
)";
}

/// Paints an exact sphere on whatever covers its silhouette.
inline std::string impostorFragmentShader() {
    return std::string("#version 120\n") + lightDeclarations + R"(
uniform vec2 tangents;
uniform vec2 viewport;
uniform float hardEdges;  // 1: a pixel is the ball's or not at all
varying vec3 center;
varying float radius;
varying vec3 ballColor;
)" + phongFunction() +
           hitFunction() + normalFunction() + depthFunction() + R"(
void main() {
    vec3 ray = vec3((2.0 * gl_FragCoord.xy / viewport - 1.0) * tangents, -1.0);

    // Where does the ray pass the centre, and how far from it? Working with that short offset
    // keeps the digits that b * b - 4.0 * a * c would lose for a small ball far away.
    float depth = dot(ray, center) / dot(ray, ray);
    vec3 offset = depth * ray - center;
    float pixel = depth * 2.0 * tangents.y / viewport.y;
    float coverage = clamp(0.5 + (radius - length(offset)) / pixel, 0.0, 1.0);
    if (hardEdges > 0.5) coverage = step(0.5, coverage);
    if (depth <= 0.0 || coverage <= 0.0) discard;
    vec3 hit = sphereHit(ray, center, radius);
    if (hit.z >= 0.0) discard;  // the eye is inside
    vec3 color = phong(sphereNormal(hit, center, radius), -normalize(ray), ballColor);
    gl_FragColor = vec4(color, coverage);
    gl_FragDepth = windowDepth(hit);
}
)";
}

inline constexpr const char* meshVertexShader = R"(#version 120
varying vec3 place, normal, ballColor;
void main() {
    vec4 inEyeSpace = gl_ModelViewMatrix * gl_Vertex;
    place = inEyeSpace.xyz;
    normal = gl_NormalMatrix * gl_Normal;
    ballColor = gl_Color.rgb;
    gl_Position = gl_ProjectionMatrix * inEyeSpace;
}
)";

/// Light at every pixel, from the normals of the corners: Phong's shading.
inline std::string meshFragmentShader() {
    return std::string("#version 120\n") + lightDeclarations + R"(
varying vec3 place, normal, ballColor;
)" + phongFunction() +
           R"(
void main() {
    gl_FragColor = vec4(phong(normalize(normal), -normalize(place), ballColor), 1.0);
}
)";
}

}  // namespace ballpit
