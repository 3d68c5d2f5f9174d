#version 460
#extension GL_GOOGLE_include_directive : require

// The finest level of a map of the widths of base lobes, where these lie on the surface otherwise
// than the normals do. Each lobe counts as much as it mirrors.

#include "lib/lobe/plane_lobe.glsl"
#include "lib/map/box_reduction.glsl"
#include "maps/mirrored_luminance.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_BASE_AS_LOBE) const bool BASE_AS_LOBE = false;

layout(set = 0, binding = 16) uniform writeonly image2DArray width_means_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

struct width_sums {
    vec4 lobes, microfacets; // the layers of the map
};

void add_point(inout width_sums sums, vec2 point, float weight) {
    float parameter = base_parameter(0, width_at(point));
    float concentration = base_lobe_concentration(DISTRIBUTION, parameter);
    float variance = BASE_AS_LOBE ? plane_variance(DISTRIBUTION_VMF, concentration)
                                  : plane_variance(DISTRIBUTION, parameter);
    float square = 2.0 / max(concentration, 1.0);
    weight *= mirrored_luminance(point, has_map(MAP_BASE_COLOUR));
    sums.lobes += weight * vec4(inversesqrt(variance), variance,
                                mean_resultant_complement(concentration), 1.0);
    sums.microfacets += weight * vec4(concentration, sqrt(square), square, 1.0);
}

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(width_means_map).xy, position))
        return;
    ivec2 size = ivec2(constants.width, constants.height);
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    width_sums sums = width_sums(vec4(0.0), vec4(0.0));
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
