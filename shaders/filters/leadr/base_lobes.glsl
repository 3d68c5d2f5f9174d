#ifndef BASE_LOBES_GLSL
#define BASE_LOBES_GLSL

// The base lobes of a footprint, from the map of base_lobes.comp.

#include "shading/slope_maps.glsl"
#include "interface/slope_moments.h"
#include "lib/lobe/plane_lobe.glsl"

layout(constant_id = SPECIALISE_BASE_LOBES) const uint BASE_LOBES = BASE_LOBES_ALIKE;

layout(LOBE_DESCRIPTOR(45)) uniform sampler2DArray base_lobe_map;

const bool BASE_HAS_TAILS =
    MODEL == MODEL_MICROFACET && DISTRIBUTION == DISTRIBUTION_GGX && !BASE_AS_LOBE;

struct base_lobes {
    float variance; // of slopes, of the lobe that stands for all
    float varies;   // variance of the logarithm of their widths, as in tail_weight
    // In terms of maps: mean colour times metal's share, and its square's; and that share.
    vec4 metal;
    float metallic;
};

// `variance`: mean of the lobes.
//
// Widths are taken to vary log-normally, as in lib/lobe/plane_lobe.glsl: with E[alpha] and
// E[alpha^2], the variance of the logarithm is log E[alpha^2]/E[alpha]^2. One lobe of the mean
// alpha stands for them elsewhere: that of the mean variance is too pale about its axis.
base_lobes fetch_base_lobes(map_area area, float variance) {
    base_lobes result = base_lobes(variance, 0.0, vec4(0.0), 0.0);
    if (BASE_LOBES == BASE_LOBES_ALIKE)
        return result;
    vec4 means = filtered_layer(base_lobe_map, area, BASE_LOBE_LAYER_WIDTHS);
    vec2 alpha = means.xy / max(means.z, 1e-6);
    if (BASE_HAS_TAILS) {
        float square = max(alpha.x * alpha.x, 2.0 / CONCENTRATION_MAXIMUM);
        result.variance = 0.5 * square;
        result.varies = clamp(log(alpha.y / square), 0.0, TAIL_VARIES_MAXIMUM);
    } else {
        result.variance = max(0.5 * alpha.y, 1.0 / CONCENTRATION_MAXIMUM);
    }
    result.metallic = means.w;
    if (BASE_LOBES == BASE_LOBES_COLOURED)
        result.metal = filtered_layer(base_lobe_map, area, BASE_LOBE_LAYER_METAL);
    return result;
}

// The mean of colours times metal's shares, where the material has the product of both means: metal
// and rust are not half metal of a colour in between. What lies below F0 is mostly where metal is
// not: the Lambert part is divided by what the mean F0 lets through, and times what its own does.
void tell_metal_apart(inout base_material filtered, base_lobes lobes, surface_point surface) {
    if (BASE_LOBES != BASE_LOBES_COLOURED)
        return;
    vec3 metal = material.metallic * material.base_colour.rgb * lobes.metal.rgb;
    if (VERTEX_COLOUR)
        metal *= surface.colour.rgb;
    // glTF 2.0, appendix B.2.
    float share = material.metallic * lobes.metallic, rest = 1.0 - share;
    vec3 colour = filtered.diffuse + filtered.specular - 0.04 * rest;
    filtered.specular = metal + 0.04 * rest;
    // Metal's share where the Lambert part is: E[m (1 - m)]/E[1 - m].
    float square = material.metallic * material.metallic * lobes.metal.a;
    float covering = clamp((share - square) / max(rest, 1e-3), 0.0, share);
    vec3 cover = mix(vec3(0.04), metal / max(share, 1e-3), covering);
    filtered.diffuse = max(colour - metal, vec3(0.0)) * max(1.0 - cover, vec3(0.0)) /
                       max(1.0 - filtered.specular, vec3(0.05));
}

#endif
