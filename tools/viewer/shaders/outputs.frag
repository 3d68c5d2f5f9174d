#version 460
#extension GL_GOOGLE_include_directive : require

// Normals or depth instead of the picture, as linear colours.

#include "outputs.h"

layout(push_constant) uniform outputs_block { outputs_constants outputs; };
layout(set = 0, binding = 0) uniform sampler2D normal_depth;

layout(location = 0) out vec4 colour_out;

void main() {
    vec4 texel = texelFetch(normal_depth, ivec2(gl_FragCoord.xy), 0);
    if (texel.w <= 0.0)
        colour_out = vec4(0.0);
    else if (outputs.depth == 0u)
        colour_out = vec4(0.5 * texel.xyz + 0.5, 1.0);
    else
        colour_out = vec4(vec3(exp2(-texel.w / outputs.scale)), 1.0);
}
