#ifndef MIRRORED_LUMINANCE_GLSL
#define MIRRORED_LUMINANCE_GLSL

// How much a microfacet material mirrors at a point of its maps: rust is rough, and mirrors a tenth
// of what the metal does.

#include "interface/mirrored.h"
#include "lib/light/luminance.glsl"
#include "maps/base_maps.glsl"

layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = false;

// F0 (glTF 2.0, appendix B.2), blended with white by LEAST_MIRRORED. The pass reads the material's
// colours, too (passes_base_maps_read). `base_colour`: of the map at the point; white without one.
vec3 mirrored_colour(vec2 point, vec3 base_colour) {
    float metallic = material.metallic;
    if (METALLIC_MAP)
        metallic *= base_texel(width_map, point).b;
    vec3 metal = material.base_colour.rgb * base_colour;
    return mix(mix(vec3(DIELECTRIC_F0), metal, metallic), vec3(1.0), LEAST_MIRRORED);
}

float mirrored_luminance(vec2 point, vec3 base_colour) {
    return lobe_luminance(mirrored_colour(point, base_colour));
}

#endif
