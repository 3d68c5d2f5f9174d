#version 460
#extension GL_GOOGLE_include_directive : require

// The triangles of all patches, as indices of their vertices.

#include "displacement/patch_search.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 14, std430) writeonly buffer index_block { uint indices[]; };

// With two segments, the line between the two triangles farthest from the largest edge runs from
// the middle of that edge to the corner opposite. The middles of the other edges may still be at
// the ends of the largest one: between the three middles would stand a wall.
void turn_middle(uint number, vec4 sizes, inout ivec3 corners[3]) {
    int edge = sizes.x == sizes.w ? 0 : sizes.y == sizes.w ? 1 : 2;
    ivec3 first = ivec3(edge == 0, edge == 1, edge == 2), second = first.zxy, last = second.zxy;
    bool between = number == 2u, opposite = number == uint[3](3u, 0u, 1u)[edge];
    for (int i = 0; i < 3; ++i)
        if (between && corners[i] == last + first)
            corners[i] = 2 * last;
        else if (opposite && corners[i] == second + last)
            corners[i] = first + second;
}

void main() {
    uint number = thread_number();
    if (number >= arguments[PATCH_TOTALS + 1])
        return;
    uint found = patch_with(number, 1);
    vec4 sizes = sizes_of_patch(found);
    int segments = segments_of(sizes.w);
    uint first = PATCH_FIRST_VERTEX + offsets[found].x;
    ivec3 corners[3];
    lattice_triangle(segments, number - offsets[found].y, corners);
    if (segments == 2)
        turn_middle(number - offsets[found].y, sizes, corners);
    for (int i = 0; i < 3; ++i)
        indices[3u * number + uint(i)] =
            first + lattice_number(segments - corners[i].x, corners[i].z);
}
