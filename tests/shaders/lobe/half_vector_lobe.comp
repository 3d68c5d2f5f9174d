#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/half_vector_lobe.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return vec4(half_vector_lobe(uint(c.x), a.xyz, b.xyz, c.y),
                    blinn_phong_lobe(a.xyz, b.xyz, c.y), 0.0, 0.0);
    default:
        return vec4(rotate_from_pole(a.xyz, b.xyz), 0.0);
    }
}
