#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/map/facing_slope.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    if (FUNCTION == 0)
        return vec4(facing_slope(a.xy, a.zw, b.xyz), 0.0, 0.0);
    return vec4(facing_normal(c.xyz, a.zw, b.xyz), 0.0);
}
