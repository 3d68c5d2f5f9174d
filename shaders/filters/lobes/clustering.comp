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
    target_points points = points_under(position, ivec2(constants.width, constants.height));
    cluster_sums sums = no_lobes();
    float complements[MATERIAL_MAXIMUM_LOBES];
    if (!has_map(MAP_WIDTH))
        base_complements(material.width_factor, complements);
    if (WEIGHTED)
        read_colours(points);
    for (int i = 0; i < count_of(points); ++i)
        add_point(sums, point_of(points, i), mat3(1.0), vec2(constants.alpha, constants.cutoff),
                  complements);
    store_clusters(position, sums);
}
