#version 460
#extension GL_GOOGLE_include_directive : require

// The first level of a channel of the map of transfer (interface/displacement/relief.h): means over
// the facets under each texel, of half the size of the relief; all within a window. A thread a
// texel.

#include "filters/displaced/facets.glsl"
#include "filters/displaced/facet_colours.glsl"
#include "filters/displaced/facet_words.glsl"
#include "lib/displacement/facets_under_texel.glsl"
#include "lib/displacement/transfer_basis.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 6, std430) readonly buffer source_block { vec4 source[]; };
layout(set = 0, binding = 7, std430) readonly buffer first_block { vec4 first_bounce[]; };
layout(set = 0, binding = 8) uniform writeonly image2DArray transfer_map;

const uint DIRECT = TRANSFER_DIRECT_COUNT(ORDER);
const uint VISIBLE = TRANSFER_ENTRIES(ORDER);
const uint MAXIMUM_ENTRIES = 68u;

float entries[MAXIMUM_ENTRIES];

float integral_of(vec4 coefficients) {
    return TRANSFER_INTEGRAL[0] * coefficients.x + TRANSFER_INTEGRAL[3] * coefficients.w;
}

void add_facet(uint index, float weight) {
    float b[TRANSFER_MAXIMUM_ORDER];
    for (uint k = 0u; k < ORDER; ++k)
        b[k] = facet_coefficient(index, k);
    vec4 own = smooth_coefficients(index);
    vec2 colour = colours_of_facet(index, transfer.channel);
    float area = weight * INVERSE_PI / facet_of(index).normal.z;
    for (uint i = 0u; i < ORDER; ++i)
        for (uint j = 0u; j <= i; ++j)
            entries[i * (i + 1u) / 2u + j] += colour.x * area * b[i] * b[j];
    for (uint i = 0u; i < ORDER; ++i)
        entries[VISIBLE + i] += PI * area * b[i];
    vec4 other = source[index];
    for (uint i = 0u; i < TRANSFER_INDIRECT; ++i)
        for (uint j = 0u; j <= i; ++j)
            entries[DIRECT + i * (i + 1u) / 2u + j] +=
                0.5 * colour.y * area * (own[i] * other[j] + own[j] * other[i]);
    entries[DIRECT + TRANSFER_INDIRECT_COUNT] +=
        COLOURED ? weight * colour.x
                 : area * integral_of(own) *
                       integral_of(first_bounce[index]) * INVERSE_PI;
}

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy + uvec2(transfer.first_column, transfer.first_row);
    uvec2 target = texel - uvec2(transfer.target_column, transfer.target_row);
    if (any(greaterThanEqual(target, uvec2(imageSize(transfer_map).xy))))
        return;
    for (uint i = 0u; i < MAXIMUM_ENTRIES; ++i)
        entries[i] = 0.0;
    add_facets_under(texel, relief_size());
    for (uint i = 0u; i < uint(imageSize(transfer_map).z); ++i)
        imageStore(transfer_map, ivec3(target, i),
                   vec4(entries[4u * i], entries[4u * i + 1u], entries[4u * i + 2u],
                        entries[4u * i + 3u]));
}
