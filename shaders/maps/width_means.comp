#version 460
#extension GL_GOOGLE_include_directive : require

// The finest level of a map of the widths of base lobes, where these lie on the surface otherwise
// than the normals do. Each lobe counts as much as it mirrors.

#include "lib/lobe/width_layers.glsl"
#include "lib/map/box_reduction.glsl"
#include "maps/mirrored_luminance.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_BASE_AS_LOBE) const bool BASE_AS_LOBE = false;

layout(set = 0, binding = 16) uniform writeonly image2DArray width_means_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

void add_point(inout width_layers sums, vec2 point, float weight) {
    width_layers one = layers_of_width(DISTRIBUTION, BASE_AS_LOBE,
                                       base_parameter(0, width_at(point)));
    weight *= mirrored_luminance(point, has_map(MAP_BASE_COLOUR));
    sums.lobes += weight * one.lobes;
    sums.microfacets += weight * one.microfacets;
}

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(width_means_map).xy, position))
        return;
    ivec2 size = ivec2(constants.width, constants.height);
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    width_layers sums = width_layers(vec4(0.0), vec4(0.0));
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x) {
            float weight = row_weights[y] * column_weights[x] / float(POINTS);
            for (int i = 0; i < POINTS; ++i)
                add_point(sums, map_point(2 * position + ivec2(x, y), i, size), weight);
        }
    }
    imageStore(width_means_map, ivec3(position, WIDTH_LAYER_LOBES), sums.lobes);
    imageStore(width_means_map, ivec3(position, WIDTH_LAYER_MICROFACETS), sums.microfacets);
}
