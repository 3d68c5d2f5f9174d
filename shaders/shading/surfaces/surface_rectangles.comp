#version 460
#extension GL_GOOGLE_include_directive : require

// Where each batch is seen in the picture of surfaces. Invocations take parts of rows.

#include "interface/picture/surfaces.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray surfaces;
layout(set = 0, binding = 1, std430) buffer rectangle_block { surface_rectangle rectangles[]; };

// Pixels [first, end) of row `y` show a batch.
void add(uint number, uint first, uint end, uint y) {
    uvec2 size = textureSize(surfaces, 0).xy;
    atomicMax(rectangles[number].right, end);
    atomicMax(rectangles[number].bottom, y + 1u);
    atomicMax(rectangles[number].from_right, size.x - first);
    atomicMax(rectangles[number].from_bottom, size.y - y);
}

void main() {
    uvec2 size = textureSize(surfaces, 0).xy;
    uint x = SURFACE_RUN * gl_GlobalInvocationID.x, y = gl_GlobalInvocationID.y;
    if (x >= size.x || y >= size.y)
        return;
    uint end = min(x + SURFACE_RUN, size.x), first = x, number = 0u;
    for (; x < end; ++x) {
        float whose = texelFetch(surfaces, ivec3(x, y, SURFACES_POSITION), 0).w;
        uint here = uint(max(whose, 0.0)) / 4u;
        if (here == number)
            continue;
        if (number > 0u)
            add(number, first, x, y);
        number = here;
        first = x;
    }
    if (number > 0u)
        add(number, first, end, y);
}
