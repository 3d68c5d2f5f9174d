#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of a map of base lobes, where roughness or metal varies. Each lobe counts as
// much as it mirrors; where that does not vary, the material's factors are left out, and all count
// alike.

#include "maps/base_maps.glsl"
#include "maps/colour_square.glsl"
#include "maps/mirrored_luminance.glsl"
#include "interface/slope_moments.h"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_BASE_LOBES) const uint BASE_LOBES = BASE_LOBES_VARY;

layout(set = 0, binding = 16) uniform writeonly image2DArray base_lobe_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

void add_point(inout vec3 widths, target_point point) {
    bool coloured = BASE_LOBES == BASE_LOBES_COLOURED && has_map(MAP_BASE_COLOUR);
    float reflected = mirrored_luminance(point.place, coloured ? base_colour_at(point).rgb
                                                               : vec3(1.0));
    float alpha = sqrt(2.0 / max(base_concentration(0, width_at(point.place)), 1.0));
    float weight = point.weight * weight_of_point(point.place, constants.alpha, constants.cutoff);
    widths += weight * reflected * vec3(alpha, alpha * alpha, 1.0);
}

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(base_lobe_map).xy, position))
        return;
    target_points points = points_under(position, ivec2(constants.width, constants.height));
    vec3 widths = vec3(0.0);
    if (BASE_LOBES == BASE_LOBES_COLOURED)
        read_colours(points);
    for (int i = 0; i < count_of(points); ++i)
        add_point(widths, point_of(points, i));
    imageStore(base_lobe_map, ivec3(position, 0), vec4(widths, 0.0));
}
