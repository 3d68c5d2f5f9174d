#version 460
#extension GL_GOOGLE_include_directive : require

// Sums roots of the picture's radiance, tile by tile. The square of their mean is the picture's
// key: a single lamp in view hardly changes it, as it would the mean, nor do shadows without any
// light, as they would the geometric mean (Reinhard et al. 2002, Photographic Tone Reproduction for
// Digital Images, section 2). In a fixed order, so that pictures do not depend on chance.

#include "interface/picture/sample_choice.h"

layout(local_size_x = KEY_GROUP, local_size_y = KEY_GROUP) in;

layout(set = 0, binding = 0) uniform sampler2D radiance;
layout(set = 0, binding = 1, std430) writeonly buffer sum_block { key_sum sums[]; };

shared vec2 partial[KEY_GROUP * KEY_GROUP];

// Root of the brightest channel, and how many texels that is; pixels without light do not count.
vec2 root_of(ivec2 position) {
    vec3 texel = texelFetch(radiance, position, 0).rgb;
    float brightest = max(texel.r, max(texel.g, texel.b));
    return brightest > 0.0 && !isinf(brightest) ? vec2(sqrt(brightest), 1.0) : vec2(0.0);
}

void main() {
    ivec2 size = textureSize(radiance, 0);
    vec2 sum = vec2(0.0);
    for (int y = 0; y < KEY_TILE; y += KEY_GROUP) {
        for (int x = 0; x < KEY_TILE; x += KEY_GROUP) {
            ivec2 position = ivec2(gl_WorkGroupID.xy) * KEY_TILE + ivec2(x, y) +
                             ivec2(gl_LocalInvocationID.xy);
            if (all(lessThan(position, size)))
                sum += root_of(position);
        }
    }
    partial[gl_LocalInvocationIndex] = sum;
    for (uint half_count = KEY_GROUP * KEY_GROUP / 2; half_count > 0u; half_count /= 2u) {
        barrier();
        if (gl_LocalInvocationIndex < half_count)
            partial[gl_LocalInvocationIndex] += partial[gl_LocalInvocationIndex + half_count];
    }
    if (gl_LocalInvocationIndex == 0u)
        sums[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] =
            key_sum(partial[0].x, partial[0].y, 0u, 0u);
}
