#ifndef BASE_LOBE_MAP_GLSL
#define BASE_LOBE_MAP_GLSL

// The map of base_lobes.comp, where there is one.

#include "shading/colours/width_means.glsl"
#include "interface/slope_moments.h"

layout(constant_id = SPECIALISE_BASE_LOBES) const uint BASE_LOBES = BASE_LOBES_ALIKE;

layout(LOBE_DESCRIPTOR(45)) uniform sampler2DArray base_lobe_map;

bool base_lobes_vary() {
    return BASE_LOBES != BASE_LOBES_ALIKE || WIDTHS_APART;
}

// Means of the widths alpha and of their squares over a footprint; texels count by what they
// mirror.
vec2 fetch_alpha_moments(map_area area, surface_point surface) {
    if (WIDTHS_APART) {
        width_means means = fetch_width_means(surface);
        return vec2(means.alpha, means.alpha_square);
    }
    vec3 means = filtered_layer(base_lobe_map, area, 0u).xyz;
    return means.xy / max(means.z, 1e-6);
}

#endif
