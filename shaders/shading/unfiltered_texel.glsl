#ifndef UNFILTERED_TEXEL_GLSL
#define UNFILTERED_TEXEL_GLSL

// A map's value at a point, as it is, and whether a mask keeps it.

#include "lib/map/base_texel.glsl"
#include "shading/surface.glsl"

vec4 unfiltered_texel(int map, sampler2D image, surface_point surface) {
    return has_map(map) ? base_texel(image, map_coordinates(map, surface.coordinates, 1.0))
                        : vec4(1.0);
}

vec4 unfiltered_base_colour(surface_point surface) {
    return unfiltered_texel(MAP_BASE_COLOUR, base_colour_map, surface);
}

// Whether the mask keeps a texel with this alpha: glTF 2.0, section 3.9.4.
bool is_kept(float alpha, surface_point surface) {
    return !(alpha * material.base_colour.a * surface.colour.a < material.emissive.w);
}

#endif
