#ifndef UNFILTERED_MAPS_GLSL
#define UNFILTERED_MAPS_GLSL

// One sample of the maps as they are, without any filtering over the pixel.

#include "shading/base_material.glsl"

vec4 unfiltered_texel(int map, sampler2D image, surface_point surface) {
    return has_map(map) ? textureLod(image, map_coordinates(map, surface.coordinates, 1.0), 0.0)
                        : vec4(1.0);
}

vec3 unfiltered_normal(surface_point surface) {
    if (!has_map(MAP_NORMAL))
        return vec3(0.0, 0.0, 1.0);
    return decode_normal(unfiltered_texel(MAP_NORMAL, normal_map, surface).xyz,
                         material.normal_scale, NORMALS);
}

vec4 unfiltered_base_colour(surface_point surface) {
    return unfiltered_texel(MAP_BASE_COLOUR, base_colour_map, surface);
}

// Whether the mask keeps a texel with this alpha: glTF 2.0, section 3.9.4.
bool is_kept(float alpha, surface_point surface) {
    return !(alpha * material.base_colour.a * surface.colour.a < material.emissive.w);
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
