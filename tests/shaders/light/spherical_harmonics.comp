#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/light/spherical_harmonics.glsl"

// a.xyz: a direction; a.w, b, c: nine coefficients.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    const float values[HARMONICS] = float[](a.w, b.x, b.y, b.z, b.w, c.x, c.y, c.z, c.w);
    vec4 coefficients[HARMONICS];
    for (int i = 0; i < HARMONICS; ++i)
        coefficients[i] = vec4(values[i]);
    switch (FUNCTION) {
    case 0:
        return harmonic_irradiance_by_degree(coefficients, a.xyz, 1.0, 1.0).xyzz;
    case 2:
        return harmonic_irradiance_from_below(coefficients, a.xyz, vec3(0.48, 0.64, 0.6)).xyzz;
    case 3:
        return harmonic_light_along(coefficients, a.xyz, vec3(0.48, 0.64, 0.6)).xyzz;
    default:
        return harmonic_irradiance_of_mean_normal(coefficients, a.xyz).xyzz;
    }
}
