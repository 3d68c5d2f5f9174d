#version 460
#extension GL_GOOGLE_include_directive : require

// Projects the radiance of a cube's texels to spherical harmonics, first step: a sum for each
// group. Ramamoorthi, Hanrahan, 2001, An Efficient Representation for Irradiance Environment Maps,
// Eq. 4: L_lm = integral of L(omega) Y_lm(omega). With each texel's exact solid angle, which is
// added up too (w of the first).

#include "environment/irradiance_harmonics.glsl"
#include "lib/light/cube_texel.glsl"
#include "lib/light/spherical_harmonics.glsl"

layout(set = 0, binding = 0) uniform sampler2DArray environment;
layout(set = 0, binding = 1, std430) writeonly buffer group_sums_block { vec4 group_sums[]; };

layout(push_constant) uniform constants_block { irradiance_harmonics_constants constants; };

void add_texel(inout vec4 own[HARMONICS], int face, ivec2 texel, int size) {
    float basis[HARMONICS];
    spherical_harmonics(cube_texel_direction(face, texel, size), basis);
    float solid_angle = cube_texel_solid_angle(texel, size);
    vec3 light = solid_angle * texelFetch(environment, ivec3(texel, face), 0).rgb;
    own[0].w += solid_angle;
    for (int i = 0; i < HARMONICS; ++i)
        own[i].rgb += basis[i] * light;
}

void main() {
    int size = int(constants.size);
    int first = int(gl_WorkGroupID.x) * HARMONICS_GROUP_TEXELS + int(gl_LocalInvocationID.x);
    vec4 own[HARMONICS];
    for (int i = 0; i < HARMONICS; ++i)
        own[i] = vec4(0.0);
    for (int i = 0; i < HARMONICS_GROUP_TEXELS; i += HARMONICS_GROUP_SIZE) {
        int row = (first + i) / size;
        if (row < 6 * size)
            add_texel(own, row / size, ivec2((first + i) % size, row % size), size);
    }
    add_up_group(own);
    if (gl_LocalInvocationID.x == 0) {
        for (int i = 0; i < HARMONICS; ++i)
            group_sums[HARMONICS * gl_WorkGroupID.x + i] = own[i];
    }
}
