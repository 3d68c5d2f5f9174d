#version 460
#extension GL_GOOGLE_include_directive : require

// One step of the light between facets: o = mean over links of b + o, of the first four functions.
// In the first step o is 0, and what results is also kept as its integral with diffuse light.

#include "interface/displacement/relief.h"
#include "lib/displacement/transfer_basis.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 4, std430) readonly buffer transfer_words { uint words[]; };
layout(set = 0, binding = 5, std430) readonly buffer link_block { uint links[]; };
layout(set = 0, binding = 6, std430) readonly buffer source_block { vec4 source[]; };
layout(set = 0, binding = 7, std430) writeonly buffer target_block { vec4 target[]; };

layout(push_constant) uniform transfer_block { transfer_constants transfer; };

vec4 seen(uint link) {
    vec4 b = vec4(unpackHalf2x16(words[link * TRANSFER_WORDS]),
                  unpackHalf2x16(words[link * TRANSFER_WORDS + 1u]));
    return transfer.first != 0u ? b : b + source[link];
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
