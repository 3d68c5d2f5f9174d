#ifndef LIB_HALF_VECTOR_LOBE_GLSL
#define LIB_HALF_VECTOR_LOBE_GLSL

#include "interface/specialisation.h"
#include "lib/number/constants.glsl"
#include "lib/number/power_of_cosine.glsl"
#include "lib/lobe/von_mises_fisher.glsl"

// Lobes rho(omega_h) of the half vector, the cosine of the incident direction included
// (Xu, Wang, Zhao, Bao, 2017, Real-Time Linear BRDF MIP-Mapping, footnote to Eq. 1).

// Xu et al., 2017, text before Eq. 13: (s + 1)/(2 pi) <omega_h, n>^s. Integral over the
// hemisphere: 1.
float blinn_phong_lobe(vec3 half_vector, vec3 mean, float exponent) {
    return (exponent + 1.0) * (0.5 * INVERSE_PI) * power_of_cosine(half_vector, mean, exponent);
}

// Either kind, by its own parameter.
float half_vector_lobe(uint distribution, vec3 half_vector, vec3 mean, float parameter) {
    return distribution == DISTRIBUTION_BLINN_PHONG
               ? blinn_phong_lobe(half_vector, mean, parameter)
               : von_mises_fisher(half_vector, mean, parameter);
}

// Turns a direction given about the pole (0, 0, 1) into one about `normal`, by the smallest
// rotation that takes the pole there (Moller, Hughes, 1999, Efficiently Building a Matrix to
// Rotate One Vector to Another):
//   v' = (v_xy + n_xy (v_z - <n_xy, v_xy> / (1 + n_z)),  n_z v_z - <n_xy, v_xy>)
// Below the equator 1/(1 + n_z) = (1 - n_z)/|n_xy|^2 keeps it accurate; at the opposite pole,
// where every half turn is smallest, the one about x is taken.
vec3 rotate_from_pole(vec3 normal, vec3 local) {
    float planar = dot(normal.xy, normal.xy);
    if (normal.z < 0.0 && planar < 1e-30) {
        return vec3(local.x, -local.yz);
    }
    float product = dot(normal.xy, local.xy);
    float quotient = normal.z >= 0.0 ? product / (1.0 + normal.z)
                                     : product * ((1.0 - normal.z) / planar);
    return vec3(local.xy + normal.xy * (local.z - quotient), normal.z * local.z - product);
}

#endif
