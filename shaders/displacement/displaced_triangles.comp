#version 460
#extension GL_GOOGLE_include_directive : require

// The triangles of all patches, as indices of their vertices.

#include "displacement/patch_search.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 14, std430) writeonly buffer index_block { uint indices[]; };

void main() {
    uint number = thread_number();
    if (number >= arguments[PATCH_TOTALS + 1])
        return;
    uint found = patch_with(number, 1);
    int segments = segments_of(sizes_of_patch(found).w);
    uint first = PATCH_FIRST_VERTEX + offsets[found].x;
    ivec3 corners[3];
    lattice_triangle(segments, number - offsets[found].y, corners);
    for (int i = 0; i < 3; ++i)
        indices[3u * number + uint(i)] =
            first + lattice_number(segments - corners[i].x, corners[i].z);
}
