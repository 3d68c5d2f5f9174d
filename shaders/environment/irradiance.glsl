#ifndef ENVIRONMENT_IRRADIANCE_GLSL
#define ENVIRONMENT_IRRADIANCE_GLSL

// What a Lambert surface gathers of the environment.

#include "environment/environment.glsl"
#include "interface/environment/irradiance_harmonics.h"
#include "lib/light/octahedron.glsl"
#include "lib/light/spherical_harmonics.glsl"
#include "shading/base_material.glsl"

layout(LOBE_DESCRIPTOR(29), std430) readonly buffer irradiance_block {
    irradiance_harmonics irradiance;
};

vec3 irradiance_remainder_at(ivec2 texel) {
    return irradiance.remainder[HARMONICS_REMAINDER_WIDTH * texel.y + texel.x].rgb;
}

// What the harmonics miss. Of normals that are distributed about a mean it fades as harmonics of
// degree 4, the lowest of those that are missing, do: as exp(-l (l + 1) / (2 kappa)), of which the
// resultant is the one of degree 1.
vec3 irradiance_remainder(vec3 mean_normal) {
    float square = min(dot(mean_normal, mean_normal), 1.0), fourth = square * square;
    vec3 direction = square > 1e-12 ? mean_normal : vec3(0.0, 0.0, 1.0);
    vec2 place = octahedron_coordinates(direction, float(HARMONICS_REMAINDER_SIZE)) *
                     float(HARMONICS_REMAINDER_WIDTH) - 0.5;
    ivec2 low = clamp(ivec2(place), ivec2(0), ivec2(HARMONICS_REMAINDER_WIDTH - 2));
    vec2 part = place - vec2(low);
    vec3 upper = mix(irradiance_remainder_at(low), irradiance_remainder_at(low + ivec2(1, 0)),
                     part.x);
    vec3 lower = mix(irradiance_remainder_at(low + ivec2(0, 1)),
                     irradiance_remainder_at(low + ivec2(1, 1)), part.x);
    return square * fourth * fourth * mix(upper, lower, part.y);
}

// Irradiance over pi, for a mean normal of at most unit length.
vec3 mean_irradiance(surface_point surface, vec3 mean_normal) {
    vec3 normal = to_environment(surface, mean_normal);
    if (ENVIRONMENT_METHOD == ENVIRONMENT_MIP)
        return environment.intensity * length(mean_normal) *
               textureLod(environment_cube, normal, 16.0).rgb;
    return (environment.intensity * INVERSE_PI) *
           max(harmonic_irradiance_of_mean_normal(irradiance.coefficients, normal) +
                   irradiance_remainder(normal),
               vec3(0.0));
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
