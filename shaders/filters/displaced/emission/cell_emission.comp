#version 460
#extension GL_GOOGLE_include_directive : require

// The first level of the layers of emission (interface/displacement/relief.h): means over the
// facets under each texel, of half the size of the relief; all within a window. A thread a texel.

#include "filters/displaced/facets.glsl"
#include "filters/displaced/facet_words.glsl"
#include "lib/displacement/facets_under_texel.glsl"
#include "lib/number/constants.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 5, std430) readonly buffer basis_block {
    transfer_basis_constants basis;
};
layout(set = 0, binding = 6, std430) readonly buffer source_block { vec4 source[]; };
layout(set = 0, binding = 7, std430) readonly buffer emitted_block { vec4 emitted[]; };
layout(set = 0, binding = 8) uniform writeonly image2DArray transfer_map;

const uint COUNT = TRANSFER_EMISSION(ORDER);
const uint LAYERS = TRANSFER_EMISSION_LAYERS(ORDER);

float entries[4u * LAYERS];

void add_facet(uint index, float weight) {
    float area = weight / facet_of(index).normal.z, everywhere = 0.0;
    vec3 sent = source[index].rgb, of_others = sent - emitted[index].rgb;
    for (uint k = 0u; k < ORDER; ++k) {
        float b = facet_coefficient(index, k);
        everywhere += INVERSE_PI * basis.integrals[k / 4u][k % 4u] * b;
        for (uint channel = 0u; channel < 3u; ++channel)
            entries[channel * COUNT + k] += area * sent[channel] * b;
    }
    for (uint channel = 0u; channel < 3u; ++channel)
        entries[channel * COUNT + ORDER] += area * of_others[channel] * everywhere;
}

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy + uvec2(transfer.first_column, transfer.first_row);
    uvec2 target = texel - uvec2(transfer.target_column, transfer.target_row);
    if (any(greaterThanEqual(target, uvec2(imageSize(transfer_map).xy))))
        return;
    for (uint i = 0u; i < 4u * LAYERS; ++i)
        entries[i] = 0.0;
    add_facets_under(texel, relief_size());
    // Half floats end here.
    for (uint i = 0u; i < 4u * LAYERS; ++i)
        entries[i] = clamp(entries[i], -65504.0, 65504.0);
    for (uint i = 0u; i < LAYERS; ++i)
        imageStore(transfer_map, ivec3(target, i),
                   vec4(entries[4u * i], entries[4u * i + 1u], entries[4u * i + 2u],
                        entries[4u * i + 3u]));
}
