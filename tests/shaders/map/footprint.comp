#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/map/footprint.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    footprint area = footprint_of(a.xy, a.zw);
    switch (FUNCTION) {
    case 0:
        return vec4(area.major_axis, area.minor_axis, area.direction);
    default:
        return vec4(level_of(area, b.x), 0.0, 0.0, 0.0);
    }
}
