#version 460
#extension GL_GOOGLE_include_directive : require

// Second step: the sum of all groups, and from radiance to irradiance. Ramamoorthi, Hanrahan, 2001,
// Eq. 8: E_lm = A_l L_lm, with the window's factor already in A_l. The sum of all solid angles is
// 4 pi up to rounding; dividing by it keeps that rounding out of a constant environment.

#include "environment/irradiance_harmonics.glsl"
#include "lib/number/constants.glsl"

layout(set = 0, binding = 0, std430) readonly buffer group_sums_block { vec4 group_sums[]; };
layout(set = 0, binding = 1, std430) writeonly buffer harmonics_block {
    irradiance_harmonics harmonics;
};

layout(push_constant) uniform constants_block { irradiance_harmonics_sum_constants constants; };

void main() {
    uint local = gl_LocalInvocationID.x;
    vec4 own[HARMONICS];
    for (int i = 0; i < HARMONICS; ++i)
        own[i] = vec4(0.0);
    for (uint group = local; group < constants.count; group += HARMONICS_GROUP_SIZE) {
        for (int i = 0; i < HARMONICS; ++i)
            own[i] += group_sums[HARMONICS * group + i];
    }
    add_up_group(own);
    if (local == 0) {
        float whole = 4.0 * PI / own[0].w;
        vec3 factors = whole * constants.band_factors.xyz;
        for (int i = 0; i < HARMONICS; ++i) {
            float factor = i == 0 ? factors.x : i < 4 ? factors.y : factors.z;
            harmonics.coefficients[i] = vec4(factor * own[i].rgb, 0.0);
        }
    }
}
