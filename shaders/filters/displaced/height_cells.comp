#version 460
#extension GL_GOOGLE_include_directive : require

// The heights of a material's relief, in widths of a texel. What is no number is 0.

#include "interface/displacement/relief.h"
#include "lib/number/finite.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D height_map;
layout(set = 0, binding = 1, std140) uniform height_field_block { height_field_constants relief; };
layout(set = 0, binding = 2, std430) buffer height_block { float heights[]; };

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy;
    if (texel.x >= relief.width || texel.y >= relief.height)
        return;
    float height = relief.scale * texelFetch(height_map, ivec2(texel), 0).r;
    heights[texel.y * relief.width + texel.x] =
        is_finite(height) ? clamp(height, -HEIGHT_MAXIMUM, HEIGHT_MAXIMUM) : 0.0;
}
