// Chapter 08: light, and an exact sphere, as text in the graphics card's own language, GLSL 1.20.
//
// All functions work in eye space: the eye is at the origin and looks along -z, and lengths are
// metres. Directions are vectors of length 1.
#pragma once

#include "common/hole.cuh"

#include <string>

namespace ballpit {

/// What the light functions below find: where "up" and the lamp are, and how much light there is.
inline constexpr const char* lightDeclarations = R"(
uniform vec3 up;        // the world's "up"
uniform vec3 keyLight;  // towards the lamp, which is far away
const vec3 skyLight = vec3(0.42, 0.45, 0.50);    // ambient: on what faces the sky,
const vec3 floorLight = vec3(0.23, 0.22, 0.23);  // and on what faces the floor
const vec3 keyColor = vec3(0.6200, 0.6014, 0.5642);
const float fill = 0.14;       // a second, weak lamp at the eye, so that no ball turns black
const float specular = 0.38;   // strength of the highlight
const float shininess = 48.0;  // the larger, the smaller the highlight
)";

/// GLSL: the colour of a surface that faces along `normal`, by Phong's model.
inline std::string phongFunction() {
    // ---- hole light.phong (about 6 lines): Ambient, diffuse and specular light
    TODO_HOLE("light.phong");
    return "vec3 phong(vec3 normal, vec3 toEye, vec3 color) { return 0.5 * color; }\n";
    // ---- end of light.phong
}

/// GLSL: the point where the ray from the eye along `ray` (not of length 1) first meets the sphere.
/// A ray that just misses it gets its own point nearest to the sphere.
inline std::string hitFunction() {
    // ---- hole impostor.hit (about 5 lines): Where the ray from the eye first meets the sphere
    TODO_HOLE("impostor.hit");
    return "vec3 sphereHit(vec3 ray, vec3 center, float radius) { return center; }\n";
    // ---- end of impostor.hit
}

/// GLSL: which way the sphere faces at a point of its surface.
inline std::string normalFunction() {
    // ---- hole impostor.normal (about 1 line): Out of the sphere, with length 1
    TODO_HOLE("impostor.normal");
    return "vec3 sphereNormal(vec3 hit, vec3 c, float r) { return vec3(0, 0, 1); }\n";
    // ---- end of impostor.normal
}

/// GLSL: the depth that the depth test compares, from 0 at the near plane to 1 at the far one, for
/// a point of eye space. gl_ProjectionMatrix is `perspective`; its column c is [c].
inline std::string depthFunction() {
    // ---- hole impostor.depth (about 2 lines): Project the point's z, divide, and move -1..1 to 0..1
    TODO_HOLE("impostor.depth");
    return "float windowDepth(vec3 hit) { return 0.5; }\n";
    // ---- end of impostor.depth
}

}  // namespace ballpit
