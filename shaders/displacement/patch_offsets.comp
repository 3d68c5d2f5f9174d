#version 460
#extension GL_GOOGLE_include_directive : require

// Chooses the least distance of vertices for which there is room, and gives each patch its place
// among the vertices and triangles, in the order of patches. One group.

#include "displacement/patches.glsl"

layout(local_size_x = PATCH_GROUP) in;

layout(set = 0, binding = 5, std430) readonly buffer patch_block { vec4 patches[]; };
layout(set = 0, binding = 6, std430) readonly buffer sum_block { uint sums[]; };
layout(set = 0, binding = 7, std430) writeonly buffer offset_block { uvec2 offsets[]; };
layout(set = 0, binding = 8, std430) writeonly buffer argument_block { uint arguments[]; };

shared uvec2 totals[PATCH_GROUP];

uint choose_spacing() {
    for (uint i = 0u; i < PATCH_SPACINGS; ++i)
        if (sums[i] <= constants.vertex_room && sums[PATCH_SPACINGS + i] <= constants.triangle_room)
            return i;
    return PATCH_SPACINGS;
}

void write_groups(uint first, uint count) {
    uint groups = (count + 63u) / 64u; // every device allows 65535 in a dimension
    arguments[first] = min(groups, 65535u);
    arguments[first + 1u] = (groups + 65534u) / 65535u;
    arguments[first + 2u] = 1u;
}

void write_arguments(uvec2 total, uint spacing) {
    arguments[PATCH_DRAW] = 3u * total.y;
    arguments[PATCH_DRAW + 1u] = total.y > 0u ? 1u : 0u;
    for (uint i = 2u; i < 5u; ++i)
        arguments[PATCH_DRAW + i] = 0u;
    write_groups(PATCH_VERTICES, total.x);
    write_groups(PATCH_TRIANGLES, total.y);
    arguments[PATCH_SPACING] = spacing;
    arguments[PATCH_TOTALS] = total.x;
    arguments[PATCH_TOTALS + 1u] = total.y;
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint spacing = choose_spacing();
    uint share = (constants.patch_count + PATCH_GROUP - 1u) / PATCH_GROUP;
    uint first = lane * share, end = min(first + share, constants.patch_count);
    uvec2 own = uvec2(0u);
    for (uint i = first; i < end; ++i)
        own += patch_counts(patches[i].w, spacing);
    totals[lane] = own;
    for (uint step = 1u; step < PATCH_GROUP; step *= 2u) {
        barrier();
        uvec2 before = lane >= step ? totals[lane - step] : uvec2(0u);
        barrier();
        totals[lane] += before;
    }
    uvec2 offset = totals[lane] - own;
    for (uint i = first; i < end; ++i) {
        offsets[i] = offset;
        offset += patch_counts(patches[i].w, spacing);
    }
    if (lane == PATCH_GROUP - 1u)
        write_arguments(offset, spacing);
}
