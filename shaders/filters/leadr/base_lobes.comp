#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of a map of base lobes, where roughness or metal varies. Each lobe counts as
// much as it mirrors; where that does not vary, the material's factors are left out, and all count
// alike.

#include "maps/base_maps.glsl"
#include "maps/mirrored_luminance.glsl"
#include "interface/slope_moments.h"
#include "lib/map/box_reduction.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_BASE_LOBES) const uint BASE_LOBES = BASE_LOBES_VARY;

layout(set = 0, binding = 16) uniform writeonly image2DArray base_lobe_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

void add_point(inout vec3 widths, vec2 point, float weight) {
    float reflected = mirrored_luminance(
        point, BASE_LOBES == BASE_LOBES_COLOURED && has_map(MAP_BASE_COLOUR));
    float alpha = sqrt(2.0 / max(base_concentration(0, width_at(point)), 1.0));
    weight *= weight_of_point(point, constants.alpha, constants.cutoff);
    widths += weight * reflected * vec3(alpha, alpha * alpha, 1.0);
}

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(base_lobe_map).xy, position))
        return;
    ivec2 size = ivec2(constants.width, constants.height);
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    vec3 widths = vec3(0.0);
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x) {
            float weight = row_weights[y] * column_weights[x] / float(POINTS);
            for (int i = 0; i < POINTS; ++i)
                add_point(widths, map_point(2 * position + ivec2(x, y), i, size), weight);
        }
    }
    imageStore(base_lobe_map, ivec3(position, 0), vec4(widths, 0.0));
}
