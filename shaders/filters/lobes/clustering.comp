#version 460
#extension GL_GOOGLE_include_directive : require

// The finest level of a map of lobe mixtures in tangent space, directly from the base maps: the
// instant BRDF map of Xu et al. 2017 has one lobe per texel, so it needs no memory of its own. The
// mixture starts where texels are averaged, at half the base maps' size.

#include "interface/lobe_grid.h"
#include "filters/lobes/clustering.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

void main() {
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(position, imageSize(mixture_map).xy)))
        return;
    ivec2 size = ivec2(constants.width, constants.height);
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    cluster_sums sums = no_lobes();
    float complements[MATERIAL_MAXIMUM_LOBES];
    if (!has_map(MAP_WIDTH))
        texel_complements(1.0, complements);
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x) {
            float weight = row_weights[y] * column_weights[x];
            ivec2 texel = 2 * position + ivec2(x, y);
            vec3 normal = texel_normal(texel, size);
            if (has_map(MAP_WIDTH))
                texel_complements(texel_width(texel, size), complements);
            add_normal(sums, normal, weight);
            for (int i = 0; i < LOBE_COUNT; ++i) {
                vec3 axis = MODEL == MODEL_MICROFACET
                                ? normal
                                : rotate_from_pole(normal, material.lobe_direction[i].xyz);
                float share = MODEL == MODEL_MICROFACET ? 1.0 : material.lobe_colour[i].w;
                add_lobe(sums, axis, complements[i], weight * share);
            }
        }
    }
    store_clusters(position, sums);
}
