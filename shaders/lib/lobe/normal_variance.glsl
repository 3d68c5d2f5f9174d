#ifndef LIB_NORMAL_VARIANCE_GLSL
#define LIB_NORMAL_VARIANCE_GLSL

#include "interface/specialisation.h"

// Lobes about normals that vary under a pixel: by their own maps, or because the surface is curved.
// A variance is that of either coordinate of the normals in the plane across their mean, radians
// squared; normals so spread have kappa_N = 1/variance.

// Toksvig, 2005, Mipmapping Normal Maps, Eq. 1: sigma^2 = (1 - |n|)/|n| of a mean normal. Normals
// that cancel leave no direction; the variance is then large but finite.
float variance_of_mean_normal(float mean_length) {
    return max(1.0 - mean_length, 0.0) / max(mean_length, 1e-4);
}

// One number for a covariance (xx, yy, xy): half its trace.
float isotropic_variance(vec3 covariance) {
    return 0.5 * (covariance.x + covariance.y);
}

// A lobe's own parameter (lib/lobe/base_lobe.glsl) with such normals, by
// 1/kappa' = 1/kappa + variance:
//   s' = s/(1 + s sigma^2), which is Toksvig, 2005, Eq. 2; the same in kappa;
//   alpha'^2 = alpha^2 + 2 sigma^2 (Olano, Baker, 2010, LEAN Mapping: variances of slopes add).
// Written so that the parameter is unchanged to the last bit if the variance is 0. Alpha is at most
// 1, where GGX is uniform: beyond that, facets would stand upright instead of facing all
// directions.
float widened_parameter(uint distribution, float parameter, float variance) {
    if (!(variance > 0.0)) {
        return parameter;
    }
    switch (distribution) {
    case DISTRIBUTION_BLINN_PHONG:
    case DISTRIBUTION_VMF:
        return parameter / (1.0 + parameter * variance);
    default:
        return min(parameter * sqrt(1.0 + 2.0 * variance / (parameter * parameter)),
                   max(parameter, 1.0));
    }
}

// 1 - |r| of a lobe with such normals. Mardia, Jupp, 2000, Directional Statistics, section 9.3:
// mean resultant lengths multiply; that of a small variance is 1 - variance.
float widened_complement(float complement, float variance) {
    return complement + variance * (1.0 - complement);
}

#endif
