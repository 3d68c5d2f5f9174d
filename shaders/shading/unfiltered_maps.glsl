#ifndef UNFILTERED_MAPS_GLSL
#define UNFILTERED_MAPS_GLSL

// One sample of the maps as they are, without any filtering over the pixel.

#include "lib/map/facing_slope.glsl"
#include "shading/base_material.glsl"
#include "shading/unfiltered_texel.glsl"

// A normal whose slopes follow the stretching of the map.
vec3 stretched_normal(vec3 normal, surface_point surface) {
    return STRETCHED ? normalize(vec3(surface.stretch * normal.xy, normal.z)) : normal;
}

vec2 facing_slope(vec2 slope, surface_point surface) {
    return DISPLACED ? facing_slope(slope, surface.drawn_slope, surface.outgoing) : slope;
}

vec3 facing_normal(vec3 normal, surface_point surface) {
    return DISPLACED ? facing_normal(normal, surface.drawn_slope, surface.outgoing) : normal;
}

vec3 unfiltered_normal(surface_point surface) {
    if (!has_map(MAP_NORMAL))
        return facing_normal(vec3(0.0, 0.0, 1.0), surface);
    vec3 texel = decode_normal(unfiltered_texel(MAP_NORMAL, normal_map, surface).xyz,
                               material.normal_scale, NORMALS);
    return facing_normal(stretched_normal(texel, surface), surface);
}

// glTF 2.0, section 3.9.3, for a texel of the occlusion map or a mean of texels.
float unoccluded(float texel) {
    return has_map(MAP_OCCLUSION) ? 1.0 + material.occlusion_strength * (texel - 1.0) : 1.0;
}

base_material unfiltered_material(surface_point surface, vec3 normal) {
    return assemble_material(surface, normal, unfiltered_base_colour(surface),
                             unfiltered_texel(MAP_WIDTH, width_map, surface),
                             unfiltered_texel(MAP_SPECULAR, specular_map, surface).rgb);
}

base_material unfiltered_material(surface_point surface) {
    return unfiltered_material(surface, unfiltered_normal(surface));
}

#endif
