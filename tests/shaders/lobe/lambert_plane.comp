#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/lambert_plane.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return vec4(plane_from_direction(a.xyz), 0.0, 0.0);
    case 1:
        return vec4(direction_from_plane(a.xy), 0.0);
    case 2:
        return vec4(direction_from_plane(plane_from_direction(a.xyz)), 0.0);
    default:
        return vec4(plane_distortion(a.xy), 0.0);
    }
}
