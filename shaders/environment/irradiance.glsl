#ifndef ENVIRONMENT_IRRADIANCE_GLSL
#define ENVIRONMENT_IRRADIANCE_GLSL

// What a Lambert surface gathers of the environment.

#include "environment/environment.glsl"
#include "interface/irradiance_harmonics.h"
#include "lib/light/spherical_harmonics.glsl"

layout(set = 0, binding = 29, std430) readonly buffer irradiance_block {
    irradiance_harmonics irradiance;
};

// Irradiance over pi, for a mean normal of at most unit length.
vec3 mean_irradiance(surface_point surface, vec3 mean_normal) {
    vec3 normal = to_environment(surface, mean_normal);
    if (ENVIRONMENT_METHOD == ENVIRONMENT_MIP)
        return environment.intensity * length(mean_normal) *
               textureLod(environment_cube, normal, 16.0).rgb;
    return (environment.intensity * INVERSE_PI) *
           harmonic_irradiance_of_mean_normal(irradiance.coefficients, normal);
}

#endif
