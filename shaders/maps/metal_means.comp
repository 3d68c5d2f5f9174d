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
#include "lib/map/base_texel.glsl"
#include "lib/map/box_reduction.glsl"
#include "maps/map_points.glsl"
#include "maps/mask_weight.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_METAL_MEANS) const uint METAL_MEANS = METAL_MEANS_ALONE;

layout(set = 0, binding = 4) uniform sampler2D base_colour_map;
layout(set = 0, binding = 6) uniform sampler2D width_map;
layout(set = 0, binding = 16) uniform writeonly image2DArray metal_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

// The layers of the map.
struct point_sums {
    vec4 metal;
    vec4 colour;
};

void add_point(inout point_sums sums, vec2 point, float weight) {
    float metallic = base_texel(width_map, point).b;
    vec4 colour = METAL_MEANS == METAL_MEANS_COLOURED || MASKED_LOBES
                      ? base_texel(base_colour_map, point)
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

// Colours that are interpolated are averaged as products of colour and metal are, see
// lib/map/texel_point.glsl.
void add_texel(inout point_sums sums, ivec2 texel, ivec2 size, float weight) {
    for (int i = 0; i < POINTS; ++i)
        add_point(sums, map_point(texel, i, size), weight / float(POINTS));
}

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(metal_map).xy, position))
        return;
    ivec2 size = ivec2(constants.width, constants.height);
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    point_sums sums = point_sums(vec4(0.0), vec4(0.0));
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x)
            add_texel(sums, 2 * position + ivec2(x, y), size,
                      row_weights[y] * column_weights[x]);
    }
    imageStore(metal_map, ivec3(position, METAL_LAYER_METAL), sums.metal);
    if (METAL_MEANS == METAL_MEANS_COLOURED)
        imageStore(metal_map, ivec3(position, METAL_LAYER_COLOUR), sums.colour);
}
