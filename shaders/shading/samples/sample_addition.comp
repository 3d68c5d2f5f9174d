#version 460
#extension GL_GOOGLE_include_directive : require

// Adds one sample to the sum of each pixel in the list, in float32. Alpha is above 0 where a sample
// hit something; in the sum it becomes the number of samples that did.

#include "interface/picture/sample_choice.h"

layout(local_size_x = 64) in;

layout(push_constant) uniform constants_block { uint taken; }; // samples in the sum
layout(set = 0, binding = 0, std430) readonly buffer list_block { uint list[]; };
layout(set = 0, binding = 1) uniform sampler2D radiance;
layout(set = 0, binding = 2, rgba32f) uniform image2D sum;

vec4 with_coverage(vec4 texel) {
    return vec4(texel.rgb, texel.a > 0.0 ? 1.0 : 0.0);
}

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint entry = 64u * group + gl_LocalInvocationID.x;
    if (entry >= list[0])
        return;
    uint place = list[SAMPLE_LIST_FIRST + entry];
    ivec2 position = ivec2(place & 0xffffu, place >> 16);
    vec4 before = imageLoad(sum, position);
    if (taken == 1u)
        before = with_coverage(before);
    imageStore(sum, position, before + with_coverage(texelFetch(radiance, position, 0)));
}
