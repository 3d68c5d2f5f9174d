#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of a map of how diffuse colours go with normals: of grooves whose left walls are
// red and whose right walls are green, light from the left shows more red.
//
// Factors of the material are left out, so that new ones rebuild nothing; not that of alpha under a
// mask.

#include "maps/base_maps.glsl"
#include "maps/colour_square.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = false;

layout(set = 0, binding = 16) uniform writeonly image2DArray colour_normal_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(colour_normal_map).xy, position))
        return;
    target_points points = points_under(position, ivec2(constants.width, constants.height));
    mat3x4 products = mat3x4(0.0);
    vec4 mean = vec4(0.0);
    read_colours(points);
    for (int i = 0; i < count_of(points); ++i) {
        target_point point = point_of(points, i);
        float metallic = METALLIC_MAP ? base_texel(width_map, point.place).b : 0.0;
        float weight =
            point.weight * weight_of_point(point.place, constants.alpha, constants.cutoff);
        vec4 normal = vec4(normal_at(point.place, constants.alpha, constants.cutoff), 1.0);
        products += outerProduct(normal, weight * (1.0 - metallic) * base_colour_at(point).rgb);
        mean += weight * normal;
    }
    for (int k = 0; k < 3; ++k)
        imageStore(colour_normal_map, ivec3(position, k), products[k]);
    imageStore(colour_normal_map, ivec3(position, COLOUR_NORMALS_MEAN), mean);
}
