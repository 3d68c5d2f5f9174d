#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of a map of how diffuse colours go with normals: of grooves whose left walls are
// red and whose right walls are green, light from the left shows more red.
//
// Factors of the material are left out, so that new ones rebuild nothing; not that of alpha under a
// mask.

#include "maps/base_maps.glsl"
#include "lib/map/box_reduction.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = false;

layout(set = 0, binding = 16) uniform writeonly image2DArray colour_normal_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(colour_normal_map).xy, position))
        return;
    ivec2 size = ivec2(constants.width, constants.height);
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    mat3x4 products = mat3x4(0.0);
    vec4 mean = vec4(0.0);
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x) {
            for (int i = 0; i < POINTS; ++i) {
                vec2 point = map_point(2 * position + ivec2(x, y), i, size);
                float metallic = METALLIC_MAP ? base_texel(width_map, point).b : 0.0;
                float weight = row_weights[y] * column_weights[x] / float(POINTS) *
                               weight_of_point(point, constants.alpha, constants.cutoff);
                vec4 normal = vec4(normal_at(point, constants.alpha, constants.cutoff), 1.0);
                vec3 colour = base_texel(base_colour_map, point).rgb;
                products += outerProduct(normal, weight * (1.0 - metallic) * colour);
                mean += weight * normal;
            }
        }
    }
    for (int k = 0; k < 3; ++k)
        imageStore(colour_normal_map, ivec3(position, k), products[k]);
    imageStore(colour_normal_map, ivec3(position, COLOUR_NORMALS_MEAN), mean);
}
