#ifndef BASE_MAPS_GLSL
#define BASE_MAPS_GLSL

// Texels of a material's normal and width map, for the passes that build filtered maps from them.
// The two may differ in size: the passes run over the larger, the smaller repeats its texels.

#include "interface/material.h"
#include "interface/specialisation.h"
#include "lib/lobe/base_lobe.glsl"
#include "lib/map/normal_map.glsl"

layout(constant_id = SPECIALISE_MODEL) const uint MODEL = MODEL_MICROFACET;
layout(constant_id = SPECIALISE_DISTRIBUTION) const uint DISTRIBUTION = DISTRIBUTION_GGX;
layout(constant_id = SPECIALISE_LOBE_COUNT) const uint LOBE_COUNT = 1;
layout(constant_id = SPECIALISE_MAPS) const uint MAPS = 0;
layout(constant_id = SPECIALISE_NORMAL_CONCENTRATION) const bool NORMAL_CONCENTRATION = false;

layout(set = 0, binding = 3, std140) uniform material_block { material_constants material; };
layout(set = 0, binding = 5) uniform sampler2D normal_map;
layout(set = 0, binding = 6) uniform sampler2D width_map;

bool has_map(int map) {
    return (MAPS & (1u << map)) != 0u;
}

vec3 texel_normal(ivec2 texel, ivec2 base_size) {
    if (!has_map(MAP_NORMAL))
        return vec3(0.0, 0.0, 1.0);
    ivec2 position = texel * textureSize(normal_map, 0) / base_size;
    return decode_normal(texelFetch(normal_map, position, 0).xyz, material.normal_scale);
}

// The factor of the material's width: red for half-vector lobes, green (roughness) for
// microfacets.
float texel_width(ivec2 texel, ivec2 base_size) {
    if (!has_map(MAP_WIDTH))
        return 1.0;
    vec4 value = texelFetch(width_map, texel * textureSize(width_map, 0) / base_size, 0);
    return MODEL == MODEL_MICROFACET ? value.g : value.r;
}

// The parameter of base lobe `i`, normals inside a texel included.
float base_parameter(int i, float factor) {
    float parameter = MODEL == MODEL_MICROFACET
                          ? microfacet_parameter(DISTRIBUTION, material.roughness * factor)
                          : base_lobe_parameter(DISTRIBUTION, material.lobe_direction[i].w * factor);
    if (NORMAL_CONCENTRATION)
        parameter = convolved_parameter(DISTRIBUTION, parameter, material.normal_concentration);
    return parameter;
}

// Its concentration kappa as a von Mises-Fisher lobe.
float base_concentration(int i, float factor) {
    return base_lobe_concentration(DISTRIBUTION, base_parameter(i, factor));
}

#endif
