#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/map/displaced_slope.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    displaced_slope waves = displaced_slope_of(a, b.x);
    switch (FUNCTION) {
    case 0:
        return vec4(waves.area, waves.slope, 0.0);
    case 1:
        return first_wave_moments(waves);
    default:
        return second_wave_moments(waves);
    }
}
