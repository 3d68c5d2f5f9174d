#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of the map of `mipmap`: normals and concentrations averaged like colours; under
// a mask, a second layer has how much of them counts.
// Xu et al. 2017, section 5.2: naive MIP-mapping averages mu and kappa of the instant BRDF map.

#include "maps/base_maps.glsl"
#include "maps/target_points.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform writeonly image2DArray parameter_map;

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

void main() {
    ivec2 position;
    if (!find_target_texel(constants.level, imageSize(parameter_map).xy, position))
        return;
    target_points points = points_under(position, ivec2(constants.width, constants.height));
    vec4 mean = vec4(0.0);
    float share = 0.0;
    for (int i = 0; i < count_of(points); ++i) {
        target_point point = point_of(points, i);
        float weight =
            point.weight * weight_of_point(point.place, constants.alpha, constants.cutoff);
        float factor = width_at(point.place);
        float width = MODEL == MODEL_MICROFACET ? base_concentration(0, factor) : factor;
        mean += weight * vec4(normal_at(point.place, constants.alpha, constants.cutoff), width);
        share += weight;
    }
    imageStore(parameter_map, ivec3(position, 0), mean);
    if (MASKED_LOBES)
        imageStore(parameter_map, ivec3(position, 1), vec4(share));
}
