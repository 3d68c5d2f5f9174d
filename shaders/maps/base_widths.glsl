#ifndef BASE_WIDTHS_GLSL
#define BASE_WIDTHS_GLSL

// How wide a material's base lobes are, by the factor that its width map gives.

#include "interface/material.h"
#include "interface/specialisation.h"
#include "lib/lobe/base_lobe.glsl"

layout(constant_id = SPECIALISE_MODEL) const uint MODEL = MODEL_MICROFACET;
layout(constant_id = SPECIALISE_DISTRIBUTION) const uint DISTRIBUTION = DISTRIBUTION_GGX;
layout(constant_id = SPECIALISE_LOBE_COUNT) const uint LOBE_COUNT = 1;
layout(constant_id = SPECIALISE_NORMAL_CONCENTRATION) const bool NORMAL_CONCENTRATION = false;

layout(set = 0, binding = 3, std140) uniform material_block { material_constants material; };

// The parameter of base lobe `i`, normals inside a texel included.
float base_parameter(int i, float factor) {
    float parameter = MODEL == MODEL_MICROFACET
                          ? microfacet_parameter(DISTRIBUTION, material.roughness * factor)
                          : base_lobe_parameter(DISTRIBUTION,
                                                material.lobe_direction[i].w * factor);
    if (NORMAL_CONCENTRATION)
        parameter = convolved_parameter(DISTRIBUTION, parameter, material.normal_concentration);
    return parameter;
}

// Its concentration kappa as a von Mises-Fisher lobe.
float base_concentration(int i, float factor) {
    return base_lobe_concentration(DISTRIBUTION, base_parameter(i, factor));
}

#endif
