#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/normal_variance.glsl"

// a: distribution, parameter, variance, 1 - |r|; b: covariance, length of the mean normal.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(widened_parameter(uint(a.x), a.y, a.z), widened_complement(a.w, a.z),
                isotropic_variance(b.xyz), variance_of_mean_normal(b.w));
}
