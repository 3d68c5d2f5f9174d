#ifndef PATCH_SEARCH_GLSL
#define PATCH_SEARCH_GLSL

// The patch of a vertex or a triangle, by its number among those of all patches.

#include "displacement/patches.glsl"

layout(set = 0, binding = 11, std430) readonly buffer patch_block { vec4 patches[]; };
layout(set = 0, binding = 12, std430) readonly buffer offset_block { uvec2 offsets[]; };
layout(set = 0, binding = 13, std430) readonly buffer argument_block { uint arguments[]; };

uint thread_number() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u +
           gl_LocalInvocationIndex;
}

// The last patch that begins at `number` or before: patches without any are never the last.
// `kind`: 0: vertices, 1: triangles.
uint patch_with(uint number, int kind) {
    uint first = 0u, end = constants.patch_count;
    while (end - first > 1u) {
        uint middle = (first + end) / 2u;
        if (offsets[middle][kind] <= number)
            first = middle;
        else
            end = middle;
    }
    return first;
}

// Log2 of the distance of vertices, over that which was asked for.
float chosen_spacing() {
    return uintBitsToFloat(arguments[PATCH_SPACING]);
}

// Of the edges, and the largest of them.
vec4 sizes_of_patch(uint number) {
    return patches[number] - chosen_spacing();
}

#endif
