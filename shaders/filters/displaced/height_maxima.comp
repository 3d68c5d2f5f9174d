#version 460
#extension GL_GOOGLE_include_directive : require

// A level of maxima of a relief, from the level before; the first from the map.

#include "filters/displaced/relief_texel.glsl"
#include "interface/displacement/relief.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint LEVEL = 1;

layout(set = 0, binding = 1, std140) uniform height_field_block { height_field_constants relief; };
layout(set = 0, binding = 2, std430) buffer maxima_block { float maxima[]; };
layout(set = 0, binding = 3) uniform sampler2D height_map;

// Quads of four by four texels have a vertex more along each axis, which may be the next period's.
uint vertex(uint i, uint size) {
    return i < size ? i : i - size;
}

float value_at(height_level source, uint x, uint y) {
    return LEVEL == 1u ? height_of_texel(texelFetch(height_map, ivec2(x, y), 0).r, relief.scale,
                                         relief.least_value, relief.largest_value)
                       : maxima[source.offset + y * source.width + x];
}

void main() {
    height_level target = relief.levels[LEVEL], source = relief.levels[LEVEL - 1u];
    uvec2 node = gl_GlobalInvocationID.xy;
    if (node.x >= target.width || node.y >= target.height)
        return;
    uint more = LEVEL == 1u ? 1u : 0u;
    uvec2 first = 4u * node, last = min(first + 4u, uvec2(source.width, source.height)) + more;
    float largest = -HEIGHT_MAXIMUM;
    for (uint y = first.y; y < last.y; ++y)
        for (uint x = first.x; x < last.x; ++x)
            largest = max(largest, value_at(source, vertex(x, source.width),
                                            vertex(y, source.height)));
    maxima[target.offset + node.y * target.width + node.x] = largest;
}
