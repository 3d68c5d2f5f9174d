#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/map/coordinate_frame.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    mat2 frame = coordinate_frame(a.xy, a.zw, b.xy, b.zw);
    return vec4(frame * c.xy, frame * c.zw);
}
