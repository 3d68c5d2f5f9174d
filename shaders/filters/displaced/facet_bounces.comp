#version 460
#extension GL_GOOGLE_include_directive : require

// One step of the light between facets: o = mean over links of r (b + o), of the first four
// polynomials, with what the facets reflect, r, of one channel. In the first step o is 0.

#include "interface/displacement/relief.h"
#include "filters/displaced/facet_colours.glsl"
#include "filters/displaced/facet_words.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 5, std430) readonly buffer link_block { uint links[]; };
layout(set = 0, binding = 6, std430) readonly buffer source_block { vec4 source[]; };
layout(set = 0, binding = 7, std430) writeonly buffer target_block { vec4 target[]; };

layout(push_constant) uniform transfer_block { transfer_constants transfer; };

vec4 seen(uint link) {
    vec4 b = smooth_coefficients(link);
    return colours_of_facet(link, transfer.channel).y *
           (transfer.first != 0u ? b : b + source[link]);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= 2u * transfer.width * transfer.height)
        return;
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < TRANSFER_LINKS; ++i) {
        uint link = links[index * TRANSFER_LINKS + i];
        if (link != ~0u)
            sum += seen(link);
    }
    target[index] = sum / float(TRANSFER_LINKS);
}
