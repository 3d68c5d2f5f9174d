#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of a map of slope moments, from the base maps: Olano, Baker 2010, LEAN Mapping,
// section 3; Dupuy et al. 2013, section 4.1. All are means of powers, which stay correct under any
// linear filter. The variance of the base lobes, alpha^2/2 = 1/kappa, is stored separately from
// those of the directions, because masking and the mean reflecting normal need both.

#include "maps/base_maps.glsl"
#include "interface/slope_moments.h"
#include "maps/target_points.glsl"
#include "maps/target_texel.glsl"
#include "lib/lobe/half_vector_lobe.glsl"
#include "lib/microfacet/slope_distribution.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform writeonly image2DArray moment_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

struct moment_sums {
    vec4 first, second;
};

void add_direction(inout moment_sums sums, vec3 direction, float variance, float weight) {
    vec2 slope = slope_of_normal(direction);
    sums.first += weight * vec4(slope, 0.0, variance);
    sums.second.xyz += weight * vec3(slope * slope, slope.x * slope.y);
}

// A uniform lobe, kappa = 0, has no variance in slopes; it counts as kappa = 1.
float base_variance(int lobe, float factor) {
    return 1.0 / max(base_concentration(lobe, factor), 1.0);
}

void add_point(inout moment_sums sums, vec3 normal, float factor, float weight) {
    sums.first.z += weight * normal.z;
    sums.second.w += weight;
    if (MODEL == MODEL_MICROFACET) {
        add_direction(sums, normal, base_variance(0, factor), weight);
        return;
    }
    for (int i = 0; i < LOBE_COUNT; ++i)
        add_direction(sums, rotate_from_pole(normal, material.lobe_direction[i].xyz),
                      base_variance(i, factor), weight * material.lobe_colour[i].w);
}

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(moment_map).xy, position))
        return;
    target_points points = points_under(position, ivec2(constants.width, constants.height));
    moment_sums sums = moment_sums(vec4(0.0), vec4(0.0));
    for (int i = 0; i < count_of(points); ++i) {
        target_point point = point_of(points, i);
        float weight =
            point.weight * weight_of_point(point.place, constants.alpha, constants.cutoff);
        vec3 normal = normal_at(point.place, constants.alpha, constants.cutoff);
        add_point(sums, normal, width_at(point.place), weight);
    }
    imageStore(moment_map, ivec3(position, SLOPE_LAYER_FIRST), sums.first);
    imageStore(moment_map, ivec3(position, SLOPE_LAYER_SECOND), sums.second);
}
