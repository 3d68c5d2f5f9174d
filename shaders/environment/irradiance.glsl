#ifndef ENVIRONMENT_IRRADIANCE_GLSL
#define ENVIRONMENT_IRRADIANCE_GLSL

// What a Lambert surface gathers of the environment.

#include "environment/environment.glsl"
#include "interface/environment/irradiance_harmonics.h"
#include "lib/light/spherical_harmonics.glsl"
#include "shading/base_material.glsl"

layout(LOBE_DESCRIPTOR(29), std430) readonly buffer irradiance_block {
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

// The same without the light from below the surface, of which normals of cosine n_z see the
// fraction (1 - n_z)/2 if it comes evenly: exact for a uniform sky over a uniform ground.
vec3 irradiance_above(surface_point surface, vec3 mean_normal) {
    vec3 all = mean_irradiance(surface, mean_normal);
    if (HORIZON == HORIZON_IGNORED || !has_map(MAP_NORMAL))
        return all;
    vec3 below = mean_irradiance(surface, vec3(0.0, 0.0, -1.0));
    return max(all - (0.5 - 0.5 * clamp(mean_normal.z, -1.0, 1.0)) * below, 0.0);
}

#endif
