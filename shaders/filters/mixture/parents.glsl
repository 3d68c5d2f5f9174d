#ifndef PARENTS_GLSL
#define PARENTS_GLSL

// Components of a coarser level's texels, where those of a level start, and the texels under one.
// This start, and few steps from it, keep each component at like places in neighbouring texels and
// levels, so that interpolation between texels does not mix components that differ.

#include "filters/mixture/components.glsl"

layout(set = 0, binding = 1) uniform sampler2DArray parent_map;
layout(set = 0, binding = 17, std140) uniform binning_block { moment_binning_constants binning; };

mixture_units units_of_map() {
    bool is_round =
        SHAPE == MIXTURE_SHAPE_AUTOMATIC ? binning.hats.w > 0.5 : SHAPE == MIXTURE_SHAPE_ROUND;
    return mixture_units(binning.hats.xy, binning.hats.z, is_round, 1.0);
}

mixture_component parent_component(ivec2 texel, int index) {
    vec4 first = texelFetch(parent_map, ivec3(texel, 2 * index), 0);
    return mixture_component(first.x, first.yzw,
                             texelFetch(parent_map, ivec3(texel, 2 * index + 1), 0));
}

// The parent of a texel in a level of `size` texels.
ivec2 parent_of(uvec2 texel, uvec2 size) {
    return ivec2((2u * texel + 1u) * uvec2(textureSize(parent_map, 0)) / (2u * size));
}

// Texels [low, high) of the grid are under a texel of a level of `size` texels, some in part.
uvec2 box_low(uvec2 texel, uvec2 size) {
    return texel * uvec2(constants.width, constants.height) / size;
}

uvec2 box_high(uvec2 texel, uvec2 size) {
    return ((texel + 1u) * uvec2(constants.width, constants.height) + size - 1u) / size;
}

// The part of column or row `at` that is in the box, of the whole box.
float box_weight(uint at, uint texel, uint size, uint grid) {
    uint low = max(at * size, texel * grid), high = min((at + 1u) * size, (texel + 1u) * grid);
    return float(high - low) / float(grid);
}

#endif
