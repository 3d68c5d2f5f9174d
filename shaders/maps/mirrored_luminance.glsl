#ifndef MIRRORED_LUMINANCE_GLSL
#define MIRRORED_LUMINANCE_GLSL

// How much a microfacet material mirrors at a point of its maps: rust is rough, and mirrors a tenth
// of what the metal does. Factors of the material are left out, so that new ones rebuild nothing.

#include "maps/base_maps.glsl"

layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = false;

// The luminance of F0 (glTF 2.0, appendix B.2). `coloured`: with the base colour map; without it,
// metal is white.
float mirrored_luminance(vec2 point, bool coloured) {
    float metallic = METALLIC_MAP ? base_texel(width_map, point).b : 1.0;
    vec3 colour = coloured ? base_texel(base_colour_map, point).rgb : vec3(1.0);
    return mix(0.04, dot(colour, vec3(0.2126, 0.7152, 0.0722)), metallic);
}

#endif
