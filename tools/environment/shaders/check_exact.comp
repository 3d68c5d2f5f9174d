#version 460
#extension GL_GOOGLE_include_directive : require

// The light that lobes about many directions receive from an environment, texel by texel: partial
// sums of
//   radiance * solid angle * exp(-kappa/2 |direction - texel|^2)
// over some texels of the cube, for several kappa at once. Each group loads texels together.

#include "check.h"
#include "lib/number/angle.glsl"
#include "lib/light/cube_texel.glsl"

layout(local_size_x = CHECK_GROUP_SIZE) in;

layout(set = 0, binding = 0) uniform sampler2DArray radiance;
layout(set = 0, binding = 1, std430) readonly buffer directions_block { vec4 directions[]; };
// Sums of the first lobe for all directions, then of the second, ...
layout(set = 0, binding = 2, std430) writeonly buffer sums_block { vec4 sums[]; };

layout(push_constant) uniform constants_block { environment_check_exact_constants constants; };

shared vec3 texel_directions[CHECK_GROUP_SIZE], texel_lights[CHECK_GROUP_SIZE];

void load_texel(uint index) {
    int size = textureSize(radiance, 0).x;
    int row = int(index) / size;
    ivec3 place = ivec3(int(index) % size, row % size, row / size);
    uint own = gl_LocalInvocationID.x;
    texel_directions[own] = cube_texel_direction(place.z, place.xy, size);
    texel_lights[own] =
        cube_texel_solid_angle(place.xy, size) * texelFetch(radiance, place, 0).rgb;
}

void main() {
    uint index = min(gl_GlobalInvocationID.x, constants.count - 1u);
    vec3 direction = directions[index].xyz;
    vec3 own[CHECK_LOBES];
    for (int lobe = 0; lobe < CHECK_LOBES; ++lobe)
        own[lobe] = vec3(0.0);
    for (uint i = 0u; i < constants.texel_count; i += CHECK_GROUP_SIZE) {
        load_texel(constants.first_texel + i + gl_LocalInvocationID.x);
        barrier();
        for (int texel = 0; texel < CHECK_GROUP_SIZE; ++texel) {
            float exponent = -0.5 * difference_squared(direction, texel_directions[texel]);
            for (int lobe = 0; lobe < CHECK_LOBES; ++lobe)
                own[lobe] +=
                    exp(constants.concentrations[lobe] * exponent) * texel_lights[texel];
        }
        barrier();
    }
    if (gl_GlobalInvocationID.x < constants.count) {
        for (uint lobe = 0u; lobe < CHECK_LOBES; ++lobe)
            sums[lobe * constants.count + index] = vec4(own[lobe], 0.0);
    }
}
