#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of a map of where a material is metal, and of the colours there. Reflectance is
// linear in colour times metal, not in both means: of gold beside black paint half of the gold's
// colour is reflected, where the means have a quarter.
//
// Factors of the material are left out, so that new ones rebuild nothing; not that of alpha under a
// mask. What the mask keeps has the mean colour that the filtered base colour map says.

#include "interface/lobe_grid.h"
#include "interface/material.h"
#include "interface/specialisation.h"
#include "maps/mask_weight.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_METAL_MEANS) const uint METAL_MEANS = METAL_MEANS_ALONE;

layout(set = 0, binding = 4) uniform sampler2D base_colour_map;
layout(set = 0, binding = 6) uniform sampler2D width_map;
layout(set = 0, binding = 16) uniform writeonly image2DArray metal_map;

#include "maps/colour_square.glsl"

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

// The layers of the map.
struct point_sums {
    vec4 metal;
    vec4 colour;
};

void add_point(inout point_sums sums, target_point point) {
    float metallic = base_texel(width_map, point.place).b, weight = point.weight;
    vec4 colour = METAL_MEANS == METAL_MEANS_COLOURED || MASKED_LOBES
                      ? base_colour_at(point)
                      : vec4(1.0);
    if (MASKED_LOBES)
        weight *= weight_of_alpha(colour.a, constants.alpha, constants.cutoff);
    if (METAL_MEANS == METAL_MEANS_COLOURED) {
        sums.metal += weight * metallic * vec4(colour.rgb, metallic);
        sums.colour += weight * (MASKED_LOBES ? vec4(metallic, 1.0, 0.0, 0.0)
                                              : vec4(colour.rgb, metallic));
    } else {
        sums.metal += weight * vec4(metallic, 1.0, 0.0, metallic * metallic);
    }
}

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(metal_map).xy, position))
        return;
    target_points points = points_under(position, ivec2(constants.width, constants.height));
    read_colours(points);
    point_sums sums = point_sums(vec4(0.0), vec4(0.0));
    // Colours that are interpolated are averaged as products of colour and metal are, see
    // lib/map/texel_point.glsl.
    for (int i = 0; i < count_of(points); ++i)
        add_point(sums, point_of(points, i));
    imageStore(metal_map, ivec3(position, METAL_LAYER_METAL), sums.metal);
    if (METAL_MEANS == METAL_MEANS_COLOURED)
        imageStore(metal_map, ivec3(position, METAL_LAYER_COLOUR), sums.colour);
}
