#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/plane_lobe.glsl"

// a: parameter, how much widths vary, or variance; b: model, distribution.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    uint model = uint(b.x), distribution = uint(b.y);
    float variance = plane_variance(distribution, a.x);
    switch (FUNCTION) {
    case 0:
        return vec4(variance, plane_mass(model, distribution, a.x),
                    parameter_of_plane_variance(distribution, variance), 0.0);
    case 1:
        return tail_weight(a.x);
    case 2:
        return tail_spread(a.x);
    default:
        float parameter = parameter_of_plane_variance(distribution, a.x);
        return vec4(plane_mass(model, distribution, parameter));
    }
}
