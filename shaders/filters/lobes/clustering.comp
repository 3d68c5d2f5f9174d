#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of a map of lobe mixtures in tangent space, directly from the base maps: the
// instant BRDF map of Xu et al. 2017 has one lobe per texel, so it needs no memory of its own. The
// mixture starts where texels are averaged, at half the base maps' size.

#include "filters/lobes/clustering.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(mixture_map).xy, position))
        return;
    ivec2 size = ivec2(constants.width, constants.height);
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    cluster_sums sums = no_lobes();
    float complements[MATERIAL_MAXIMUM_LOBES];
    if (!has_map(MAP_WIDTH))
        base_complements(material.width_factor, complements);
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x) {
            float weight = row_weights[y] * column_weights[x];
            add_texel(sums, 2 * position + ivec2(x, y), size, mat3(1.0),
                      vec2(constants.alpha, constants.cutoff), complements, weight);
        }
    }
    store_clusters(position, sums);
}
