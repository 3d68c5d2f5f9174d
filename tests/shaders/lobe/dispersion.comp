#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/dispersion.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(dispersion(a.x, a.y), transition(b.x, b.y, b.z), 0.0, 0.0);
}
