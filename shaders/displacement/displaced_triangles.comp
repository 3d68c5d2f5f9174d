#version 460
#extension GL_GOOGLE_include_directive : require

// The triangles of all patches, as indices of their vertices.

#include "displacement/patch_search.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 14, std430) writeonly buffer index_block { uint indices[]; };

uint vertex_of_lattice(int segments, ivec3 weights) {
    return lattice_number(segments - weights.x, weights.z);
}

// With two segments, four triangles meet at the vertex in the middle, which replace the two that
// are farthest from the largest edge; two others are at its ends.
uint vertex_around(vec4 sizes, uint triangle, int corner) {
    const int ring[4] = int[4](1, 3, 4, 5);
    if (triangle >= 2u && corner == 2)
        return counts_of(2).x - 1u;
    int number = triangle == 0u   ? int[3](0, 1, 5)[corner]
                 : triangle == 1u ? int[3](1, 2, 3)[corner]
                                  : ring[(int(triangle) - 2 + corner) % 4];
    return vertex_of_lattice(2, point_around(sizes, number));
}

void main() {
    uint number = thread_number();
    if (number >= arguments[PATCH_TOTALS + 1])
        return;
    uint found = patch_with(number, 1);
    vec4 sizes = sizes_of_patch(found);
    int segments = segments_of(sizes.w);
    uint first = PATCH_FIRST_VERTEX + offsets[found].x;
    uint own = number - offsets[found].y;
    ivec3 corners[3];
    lattice_triangle(segments, own, corners);
    for (int i = 0; i < 3; ++i)
        indices[3u * number + uint(i)] =
            first + (segments == 2 ? vertex_around(sizes, own, i)
                                   : vertex_of_lattice(segments, corners[i]));
}
