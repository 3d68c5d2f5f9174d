#version 460
#extension GL_GOOGLE_include_directive : require

// The finest level of a map of the widths of base lobes, where these lie on the surface otherwise
// than the normals do. Each lobe counts as much as it mirrors.

#include "lib/lobe/width_layers.glsl"
#include "maps/mirrored_luminance.glsl"
#include "maps/colour_square.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_BASE_AS_LOBE) const bool BASE_AS_LOBE = false;

layout(set = 0, binding = 16) uniform writeonly image2DArray width_means_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

void add_point(inout width_layers sums, target_point point) {
    width_layers one = layers_of_width(DISTRIBUTION, BASE_AS_LOBE,
                                       base_parameter(0, width_at(point.place)));
    float weight =
        point.weight * mirrored_luminance(point.place, has_map(MAP_BASE_COLOUR)
                                                           ? base_colour_at(point).rgb
                                                           : vec3(1.0));
    sums.lobes += weight * one.lobes;
    sums.microfacets += weight * one.microfacets;
}

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(width_means_map).xy, position))
        return;
    target_points points = points_under(position, ivec2(constants.width, constants.height));
    width_layers sums = width_layers(vec4(0.0), vec4(0.0));
    read_colours(points);
    for (int i = 0; i < count_of(points); ++i)
        add_point(sums, point_of(points, i));
    imageStore(width_means_map, ivec3(position, WIDTH_LAYER_LOBES), sums.lobes);
    imageStore(width_means_map, ivec3(position, WIDTH_LAYER_MICROFACETS), sums.microfacets);
}
