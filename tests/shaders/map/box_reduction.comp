#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/map/box_reduction.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    int size = int(a.x);
    switch (FUNCTION) {
    case 0:
        return vec4(box_weights(size, int(a.y)), 0.0);
    default:
        return vec4(box_taps(size));
    }
}
