// The shaders of the floor: its grid, and the shade of the balls, which is painted from above into
// a texture first.
#pragma once

#include <string>

namespace ballpit {

/// A blob of shade below each ball; the higher the ball, the wider and fainter. Where blobs overlap
/// the darker one counts, so that a crowd of balls does not turn the floor black.
inline constexpr const char* shadeDeclarations = R"(#version 120
uniform vec3 floorCorner;  // the floor's lower corner
uniform vec2 floorSize;    // m, in x and z
uniform vec2 texels;       // of the texture that covers the floor
attribute vec4 ball;
varying vec2 middle;       // of the blob, m from the corner
varying float blobRadius;  // m
varying float strength;

void placeBlob() {
    float height = max(ball.y - floorCorner.y, 0.0) / ball.w;
    float texel = max(floorSize.x / texels.x, floorSize.y / texels.y);
    middle = ball.xz - floorCorner.xz;
    blobRadius = max(ball.w * (1.25 + 0.05 * min(height, 20.0)), texel);
    strength = 0.62 / (1.0 + 0.12 * height);
}

vec4 onTexture(vec2 place) { return vec4(2.0 * place / floorSize - 1.0, 0.0, 1.0); }
)";

inline std::string quadShadeVertexShader() {
    return std::string(shadeDeclarations) + R"(
attribute vec2 corner;
void main() {
    placeBlob();
    gl_Position = onTexture(middle + blobRadius * (2.0 * corner - 1.0));
}
)";
}

inline std::string pointShadeVertexShader() {
    return std::string(shadeDeclarations) + R"(
void main() {
    placeBlob();
    bool isSane = ball.w > 0.0 && dot(ball.xyz, ball.xyz) < 1e30;
    gl_Position = isSane ? onTexture(middle) : vec4(2.0, 2.0, 0.0, 1.0);
    gl_PointSize = 2.0 * blobRadius * max(texels.x / floorSize.x, texels.y / floorSize.y);
}
)";
}

inline constexpr const char* shadeFragmentShader = R"(#version 120
uniform vec2 floorSize;
uniform vec2 texels;
varying vec2 middle;
varying float blobRadius;
varying float strength;
void main() {
    vec2 offset = (gl_FragCoord.xy / texels * floorSize - middle) / blobRadius;
    float shade = max(1.0 - dot(offset, offset), 0.0);
    gl_FragColor = vec4(strength * shade * shade);
}
)";

inline constexpr const char* floorVertexShader = R"(#version 120
varying vec2 place;    // in grid cells
varying vec2 onFloor;  // 0..1
void main() {
    place = gl_MultiTexCoord0.xy;
    onFloor = gl_MultiTexCoord1.xy;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

inline constexpr const char* floorFragmentShader = R"(#version 120
uniform sampler2D shade;
uniform float grid;  // 1: with lines
varying vec2 place;
varying vec2 onFloor;
void main() {
    vec2 toLine = 0.5 - abs(fract(place) - 0.5);
    vec2 lines = grid * clamp(1.2 - toLine / fwidth(place), 0.0, 1.0);
    vec3 color = mix(vec3(0.86, 0.87, 0.89), vec3(0.60, 0.64, 0.70), max(lines.x, lines.y));
    gl_FragColor = vec4(mix(color, vec3(0.10, 0.12, 0.20), texture2D(shade, onFloor).r), 1.0);
}
)";

}  // namespace ballpit
