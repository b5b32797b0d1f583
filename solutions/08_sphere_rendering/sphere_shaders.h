// The shaders that make a square look like a sphere. All of them work in eye space: the eye is at 0
// and looks along -z. GLSL 1.20, so that OpenGL 2.1 is enough.
#pragma once

namespace ballpit {

/// Puts a quad's corner so that the quad just covers a sphere's silhouette, which is an ellipse
/// off the picture's centre.
inline constexpr const char* ballVertexShader = R"(#version 120
uniform vec2 tangents;  // of half the field of view, across and along
uniform vec2 viewport;  // in pixels
attribute vec4 ball;    // centre and radius
attribute vec3 color;
attribute vec2 corner;  // of the quad, each 0 or 1
varying vec3 center;
varying float radius;
varying vec3 ballColor;

// Seen from above, the two tangents from the eye to a circle at (x, depth) meet the plane at
// depth 1 here.
vec2 silhouette(float x, float depth, float radius) {
    float root = radius * sqrt(x * x + depth * depth - radius * radius);
    return vec2(x * depth - root, x * depth + root) / (depth * depth - radius * radius);
}

void main() {
    center = (gl_ModelViewMatrix * vec4(ball.xyz, 1.0)).xyz;
    radius = ball.w;
    ballColor = color;
    vec2 lower = vec2(-1.0), upper = vec2(1.0);  // right for a ball that the eye's plane cuts
    if (-center.z > 1.001 * radius) {
        vec2 across = silhouette(center.x, -center.z, radius);
        vec2 along = silhouette(center.y, -center.z, radius);
        vec2 softEdge = 2.0 / viewport;
        lower = vec2(across.x, along.x) / tangents - softEdge;
        upper = vec2(across.y, along.y) / tangents + softEdge;
    }
    if (center.z > radius) lower = upper = vec2(2.0);  // behind the eye
    gl_Position = vec4(mix(lower, upper, corner), 0.0, 1.0);
}
)";

inline constexpr const char* ballFragmentShader = R"(#version 120
uniform vec2 tangents;
uniform vec2 viewport;
uniform vec3 up;        // directions of unit length
uniform vec3 keyLight;  // towards the light
varying vec3 center;
varying float radius;
varying vec3 ballColor;

void main() {
    vec3 ray = vec3((2.0 * gl_FragCoord.xy / viewport - 1.0) * tangents, -1.0);

    // Where does the ray pass the centre, and how far from it? Working with that short offset
    // keeps the digits that b * b - 4.0 * a * c would lose for a small ball far away.
    float depth = dot(ray, center) / dot(ray, ray);
    vec3 offset = depth * ray - center;
    float pixel = depth * 2.0 * tangents.y / viewport.y;
    float coverage = clamp(0.5 + (radius - length(offset)) / pixel, 0.0, 1.0);
    if (depth <= 0.0 || coverage <= 0.0) discard;
    float halfChord = sqrt(max(radius * radius - dot(offset, offset), 0.0));
    vec3 toEye = -normalize(ray);
    vec3 hit = depth * ray + halfChord * toEye;
    if (hit.z >= 0.0) discard;  // the eye is inside
    vec3 normal = (hit - center) / radius;

    // Phong: ambient light from sky and floor, diffuse and specular light from the key light, and
    // a soft fill from the eye's side so that no ball turns black.
    float sky = 0.5 + 0.5 * dot(normal, up);
    float key = max(dot(normal, keyLight), 0.0);
    float fill = max(dot(normal, toEye), 0.0);
    vec3 light = mix(vec3(0.23, 0.22, 0.23), vec3(0.42, 0.45, 0.50), sky) +
                 0.62 * key * vec3(1.0, 0.97, 0.91) + 0.14 * fill;
    float shine = pow(max(dot(reflect(-keyLight, normal), toEye), 0.0), 48.0);
    gl_FragColor = vec4(ballColor * light + 0.38 * shine, coverage);

    float clipDepth = (gl_ProjectionMatrix[2].z * hit.z + gl_ProjectionMatrix[3].z) / -hit.z;
    gl_FragDepth = 0.5 + 0.5 * clipDepth;
}
)";

/// A blob of shade on the floor under each ball; the higher the ball, the wider and fainter.
inline constexpr const char* shadowVertexShader = R"(#version 120
uniform float floorHeight;
attribute vec4 ball;
attribute vec2 corner;
varying vec2 offset;  // from the blob's centre, in its radii
varying float strength;

void main() {
    float height = max(ball.y - floorHeight, 0.0) / ball.w;
    float radius = ball.w * (1.25 + 0.05 * min(height, 20.0));
    strength = 0.62 / (1.0 + 0.12 * height);
    offset = 2.0 * corner - 1.0;
    vec2 place = ball.xz + radius * offset;
    gl_Position = gl_ModelViewProjectionMatrix * vec4(place.x, floorHeight, place.y, 1.0);
    // Just before the background: what is farther than the floor is where the floor is.
    gl_Position.z = 0.999998 * gl_Position.w;
}
)";

inline constexpr const char* shadowFragmentShader = R"(#version 120
varying vec2 offset;
varying float strength;
void main() {
    float light = max(1.0 - dot(offset, offset), 0.0);
    gl_FragColor = vec4(0.10, 0.12, 0.20, strength * light * light);
}
)";

inline constexpr const char* floorVertexShader = R"(#version 120
varying vec2 place;
void main() {
    place = gl_MultiTexCoord0.xy;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

inline constexpr const char* floorFragmentShader = R"(#version 120
varying vec2 place;  // in grid cells
void main() {
    vec2 toLine = 0.5 - abs(fract(place) - 0.5);
    vec2 lines = clamp(1.2 - toLine / fwidth(place), 0.0, 1.0);
    vec3 color = mix(vec3(0.86, 0.87, 0.89), vec3(0.60, 0.64, 0.70), max(lines.x, lines.y));
    gl_FragColor = vec4(color, 1.0);
}
)";

}  // namespace ballpit
