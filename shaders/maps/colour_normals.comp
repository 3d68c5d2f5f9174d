#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of a map of how diffuse colours go with normals: of grooves whose left walls are
// red and whose right walls are green, light from the left shows more red.
//
// Factors of the material are left out, so that new ones rebuild nothing; not that of alpha under a
// mask: what it cuts away counts neither in colours nor in normals.

#include "maps/base_maps.glsl"
#include "interface/lobe_grid.h"
#include "lib/map/box_reduction.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_ALPHA_MASK) const bool ALPHA_MASK = false;
layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = false;

layout(set = 0, binding = 4) uniform sampler2D base_colour_map;
layout(set = 0, binding = 16) uniform writeonly image2DArray colour_normal_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

// One where the mask keeps a point of this alpha, else zero.
float kept_share(float alpha) {
    return ALPHA_MASK && alpha * constants.alpha < constants.cutoff ? 0.0 : 1.0;
}

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(colour_normal_map).xy, position))
        return;
    ivec2 size = ivec2(constants.width, constants.height);
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    mat3x4 products = mat3x4(0.0);
    vec4 mean = vec4(0.0), kept = vec4(0.0);
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x) {
            float weight = row_weights[y] * column_weights[x] / float(POINTS);
            for (int i = 0; i < POINTS; ++i) {
                vec2 point = map_point(2 * position + ivec2(x, y), i, size);
                float metallic = METALLIC_MAP ? base_texel(width_map, point).b : 0.0;
                vec3 normal = normal_at(point);
                vec4 colour = base_texel(base_colour_map, point);
                float share = weight * kept_share(colour.a);
                products += outerProduct(vec4(normal, 1.0), share * (1.0 - metallic) * colour.rgb);
                mean += vec4(weight * normal, share);
                kept += vec4(share * normal, 0.0);
            }
        }
    }
    for (int k = 0; k < 3; ++k)
        imageStore(colour_normal_map, ivec3(position, k), products[k]);
    imageStore(colour_normal_map, ivec3(position, COLOUR_NORMALS_MEAN), mean);
    if (ALPHA_MASK)
        imageStore(colour_normal_map, ivec3(position, COLOUR_NORMALS_KEPT), kept);
}
