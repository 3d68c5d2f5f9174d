#ifndef MIRRORED_LUMINANCE_GLSL
#define MIRRORED_LUMINANCE_GLSL

// How much a microfacet material mirrors at a point of its maps: rust is rough, and mirrors a tenth
// of what the metal does.

#include "interface/mirrored.h"
#include "lib/light/luminance.glsl"
#include "maps/base_maps.glsl"

layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = false;

// The luminance of F0 (glTF 2.0, appendix B.2). The pass reads the material's colours, too
// (passes_base_maps_read). `base_colour`: of the map at the point; white without one.
float mirrored_luminance(vec2 point, vec3 base_colour) {
    float metallic = material.metallic;
    if (METALLIC_MAP)
        metallic *= base_texel(width_map, point).b;
    float metal = lobe_luminance(material.base_colour.rgb * base_colour);
    return mix(mix(DIELECTRIC_F0, metal, metallic), 1.0, LEAST_MIRRORED);
}

#endif
