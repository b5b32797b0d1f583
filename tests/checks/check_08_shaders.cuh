// Checks of chapter 08's GLSL functions, each alone: one pixel computes what a lesson could by
// hand.
#pragma once

#include <cmath>

#include "08_sphere_rendering/opengl_program.h"
#include "08_sphere_rendering/render_target.h"
#include "08_sphere_rendering/shading.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

/// A call of a GLSL function that gives a vec3, and what it must give, each number between -8
/// and 8.
struct Call08 {
    std::string call;
    Vec3 expected;
};

/// Component `index` of what `call` gives, by one pixel of two digits to the base 255.
inline float evaluated(const std::string& functions, const std::string& call, int index) {
    const OpenGLProgram program("#version 120\nvoid main() { gl_Position = gl_Vertex; }\n",
                                "#version 120\n" + functions +
                                    "\nvoid main() {\n    float v = 255.0 * clamp(0.5 + (" + call +
                                    ")[" + std::to_string(index) +
                                    "] / 16.0, 0.0, 1.0);\n    gl_FragColor = vec4(floor(v) / "
                                    "255.0, fract(v), 0, 1);\n}\n");
    const RenderTarget target(1, 1);
    target.bind();
    glMatrixMode(GL_PROJECTION);
    // perspective() with near 1 m, far 9 m and 90 degrees.
    const float projection[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.25f, -1, 0, 0, -2.25f, 0};
    glLoadMatrixf(projection);
    program.use();
    program.set("up", Vec3{0, 1, 0});
    program.set("keyLight", Vec3{0, 1, 0});
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glRectf(-1, -1, 1, 1);
    glUseProgram(0);
    unsigned char pixel[4] = {};
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    const float v = (static_cast<float>(pixel[0]) + static_cast<float>(pixel[1]) / 255.0f) / 255.0f;
    return 16.0f * (v - 0.5f);
}

inline void requireCalls(Report& report, const std::string& functions,
                         const std::vector<Call08>& calls) {
    for (const auto& [call, expected] : calls) {
        const Vec3 got{evaluated(functions, call, 0), evaluated(functions, call, 1),
                       evaluated(functions, call, 2)};
        if (!(length(got - expected) <= 0.003f)) report.fail(call, text(got), text(expected));
    }
}

inline void phongByHand(Report& report) {
    requireCalls(report, lightDeclarations + phongFunction(),
                 {{"phong(vec3(0, 1, 0), vec3(0, 0, 1), vec3(1))", {1.04f, 1.0514f, 1.0642f}},
                  {"phong(vec3(0, -1, 0), vec3(0, 0, 1), vec3(1))", {0.23f, 0.22f, 0.23f}},
                  {"phong(vec3(0, 0, 1), vec3(0, 0, 1), vec3(1, 0, 0.5))", {0.465f, 0, 0.2525f}},
                  {"phong(vec3(0, 0.70711, 0.70711), vec3(0, 0, 1), vec3(0.5))",
                   {0.8448f, 0.8503f, 0.8592f}}});
}

inline void hitByHand(Report& report) {
    requireCalls(report, hitFunction(),
                 {{"sphereHit(vec3(0, 0, -1), vec3(0.6, 0, -5), 1.0)", {0, 0, -4.2f}},
                  {"sphereHit(vec3(0, 0, -2), vec3(0.6, 0, -5), 1.0)", {0, 0, -4.2f}},
                  {"sphereHit(vec3(0.75, 0, -1), vec3(3, 0, -4), 1.0)", {2.4f, 0, -3.2f}},
                  {"sphereHit(vec3(0, 0, -1), vec3(1.5, 0, -5), 1.0)", {0, 0, -5}}});
}

inline void normalByHand(Report& report) {
    requireCalls(report, normalFunction(),
                 {{"sphereNormal(vec3(0, 0, -4.2), vec3(0.6, 0, -5), 1.0)", {-0.6f, 0, 0.8f}},
                  {"sphereNormal(vec3(0, 2, -5), vec3(0, 0, -5), 2.0)", {0, 1, 0}}});
}

inline void depthByHand(Report& report) {
    requireCalls(report, depthFunction(),
                 {{"vec3(windowDepth(vec3(0, 0, -1)))", {0, 0, 0}},
                  {"vec3(windowDepth(vec3(0, 0, -9)))", {1, 1, 1}},
                  {"vec3(windowDepth(vec3(2, 1, -3)))", {0.75f, 0.75f, 0.75f}}});
}

}  // namespace ballpit::check
