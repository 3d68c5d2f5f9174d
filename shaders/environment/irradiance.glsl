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

// Of that, what comes from below the surface: from a cube's last level as if it came evenly.
vec3 irradiance_from_below(surface_point surface, vec3 mean_normal) {
    if (ENVIRONMENT_METHOD == ENVIRONMENT_MIP)
        return (0.5 - 0.5 * clamp(mean_normal.z, -1.0, 1.0)) *
               mean_irradiance(surface, vec3(0.0, 0.0, -1.0));
    return (environment.intensity * INVERSE_PI) *
           harmonic_irradiance_from_below(irradiance.coefficients,
                                          to_environment(surface, mean_normal),
                                          to_environment(surface, vec3(0.0, 0.0, 1.0)));
}

vec3 irradiance_above(surface_point surface, vec3 mean_normal) {
    vec3 all = mean_irradiance(surface, mean_normal);
    if (HORIZON == HORIZON_IGNORED || !has_map(MAP_NORMAL))
        return all;
    return max(all - irradiance_from_below(surface, mean_normal), 0.0);
}

#endif
