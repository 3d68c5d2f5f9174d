#ifndef LIB_CHARACTERISTIC_VECTOR_GLSL
#define LIB_CHARACTERISTIC_VECTOR_GLSL

#include "lib/number/constants.glsl"
#include "lib/lobe/von_mises_fisher.glsl"

// Xu, Wang, Zhao, Bao, 2017, Real-Time Linear BRDF MIP-Mapping, Eqs. 8 to 10: a von Mises-Fisher
// lobe is the vector r = R(kappa) mu, its mean direction unnormalised; a mean of such vectors
// represents the mean of the lobes.

// xyz: r; w: 1 - |r|, which r itself only holds to 1e-7.
vec4 characteristic_vector(vec3 mean, float concentration) {
    return vec4(mean_resultant_length(concentration) * mean,
                mean_resultant_complement(concentration));
}

// 1 - |r| where only the weighted sum of vectors and its weight are stored: r = sum / weight.
// The difference is taken before the division, which would round |r| once more. In [0, 1]; 1
// (a uniform lobe) for no weight.
float resultant_complement(vec3 weighted_sum, float weight) {
    return weight > 0.0 ? clamp((weight - length(weighted_sum)) / weight, 0.0, 1.0) : 1.0;
}

// mu of a characteristic vector of any length and weight; `fallback` where it has no direction.
vec3 mean_direction(vec3 r, vec3 fallback) {
    // Scaled first: the square of a length below 1e-19 would vanish.
    float largest = max(max(abs(r.x), abs(r.y)), abs(r.z));
    vec3 scaled = r / max(largest, 1e-30);
    return largest > 1e-30 ? scaled * inversesqrt(dot(scaled, scaled)) : fallback;
}

// kappa of a characteristic vector, with 1 - |r| carried beside it or not.
float concentration_of(vec3 r, float complement) {
    return concentration_from_resultant(length(r), complement);
}

float concentration_of(vec3 r) {
    return concentration_of(r, resultant_complement(r, 1.0));
}

#endif
