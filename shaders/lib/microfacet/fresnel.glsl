#ifndef LIB_FRESNEL_GLSL
#define LIB_FRESNEL_GLSL

// Schlick, 1994, An Inexpensive BRDF Model for Physically-Based Rendering, Eq. 15:
//   F = F_0 + (F_90 - F_0) (1 - <omega_i, omega_h>)^5
vec3 fresnel_schlick(vec3 f0, vec3 f90, float cosine) {
    float complement = clamp(1.0 - cosine, 0.0, 1.0);
    float square = complement * complement;
    return mix(f0, f90, square * square * complement);
}

#endif
