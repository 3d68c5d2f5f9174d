#ifndef BASE_MAPS_GLSL
#define BASE_MAPS_GLSL

// The normal and width of a material's surface, for the passes that build filtered maps from it.
//
// The surface is what shading sees: maps whose sampler is linear are interpolated between texels,
// and normals made unit length after that. The passes run over the texels of the larger map and
// read both maps at a few points inside each texel.

#include "interface/lobe_grid.h"
#include "lib/map/base_texel.glsl"
#include "lib/map/normal_map.glsl"
#include "maps/base_widths.glsl"
#include "maps/map_points.glsl"
#include "maps/mask_weight.glsl"

layout(constant_id = SPECIALISE_MAPS) const uint MAPS = 0;
layout(constant_id = SPECIALISE_NORMALS) const uint NORMALS = NORMALS_UNSIGNED;

layout(set = 0, binding = 4) uniform sampler2D base_colour_map;
layout(set = 0, binding = 5) uniform sampler2D normal_map;
layout(set = 0, binding = 6) uniform sampler2D width_map;

bool has_map(int map) {
    return (MAPS & (1u << map)) != 0u;
}

// `factor`, `cutoff`: of the mask, as in lobe_grid_constants. In its holes the surface is level: a
// normal may hold anything there, and a steep one would be seen beside a polish however little it
// counts.
vec3 normal_at(vec2 point, float factor, float cutoff) {
    bool is_seen = !MASKED_LOBES ||
                   !is_cut(base_texel(base_colour_map, point).a, factor, cutoff);
    return has_map(MAP_NORMAL) && is_seen
               ? decode_normal(textureLod(normal_map, point, 0.0).xyz, material.normal_scale,
                               NORMALS)
               : vec3(0.0, 0.0, 1.0);
}

// How much a point counts. `factor`, `cutoff`: of the mask, as in lobe_grid_constants.
float weight_of_point(vec2 point, float factor, float cutoff) {
    return MASKED_LOBES
               ? weight_of_alpha(base_texel(base_colour_map, point).a, factor, cutoff)
               : 1.0;
}

// The factor of the material's width: red for half-vector lobes, green (roughness) for
// microfacets.
float width_at(vec2 point) {
    if (!has_map(MAP_WIDTH))
        return material.width_factor;
    vec4 value = base_texel(width_map, point);
    return MODEL == MODEL_MICROFACET ? value.g : value.r;
}

#endif
