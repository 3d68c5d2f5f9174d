#ifndef BASE_LOBES_GLSL
#define BASE_LOBES_GLSL

// The base lobes of a footprint, from the map of base_lobes.comp.

#include "shading/slope_maps.glsl"
#include "filters/leadr/base_lobe_map.glsl"
#include "lib/lobe/plane_lobe.glsl"

const bool BASE_HAS_TAILS =
    MODEL == MODEL_MICROFACET && DISTRIBUTION == DISTRIBUTION_GGX && !BASE_AS_LOBE;

struct base_lobes {
    float variance; // of slopes, of the lobe that stands for all
    float varies;   // variance of the logarithm of their widths, as in tail_weight
};

// `variance`: mean of the lobes.
//
// Widths are taken to vary log-normally, as in lib/lobe/plane_lobe.glsl: with E[alpha] and
// E[alpha^2], the variance of the logarithm is log E[alpha^2]/E[alpha]^2. One lobe of the mean
// alpha stands for them elsewhere: that of the mean variance is too pale about its axis.
base_lobes fetch_base_lobes(map_area area, float variance, surface_point surface) {
    base_lobes result = base_lobes(variance, 0.0);
    if (!base_lobes_vary())
        return result;
    vec2 alpha = fetch_alpha_moments(area, surface);
    if (BASE_HAS_TAILS) {
        float square = max(alpha.x * alpha.x, 2.0 / CONCENTRATION_MAXIMUM);
        result.variance = 0.5 * square;
        result.varies = clamp(log(alpha.y / square), 0.0, TAIL_VARIES_MAXIMUM);
    } else {
        result.variance = max(0.5 * alpha.y, 1.0 / CONCENTRATION_MAXIMUM);
    }
    return result;
}

#endif
