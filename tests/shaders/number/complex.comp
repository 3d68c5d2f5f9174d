#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/number/complex.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0: // in 16 bits each
        return vec4(turned(uint(a.x) * 65536u + uint(a.y)), 0.0, 0.0);
    case 1:
        return vec4(times(a.xy, b.xy), times_i(a.xy));
    default:
        return vec4(conjugate(a.xy), 0.0, 0.0);
    }
}
