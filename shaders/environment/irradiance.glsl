#ifndef ENVIRONMENT_IRRADIANCE_GLSL
#define ENVIRONMENT_IRRADIANCE_GLSL

// What a Lambert surface gathers of the environment.

#include "environment/environment.glsl"
#include "interface/environment/irradiance_harmonics.h"
#include "lib/light/octahedron.glsl"
#include "lib/light/spherical_harmonics.glsl"
#include "shading/base_material.glsl"

layout(LOBE_DESCRIPTOR(29), std140) uniform irradiance_block { irradiance_harmonics irradiance; };
layout(LOBE_DESCRIPTOR(54)) uniform sampler2D irradiance_remainder_map;

// What the harmonics miss. w: of the light near the horizon, the share from below. `direction`: of
// any length but 0, in the environment's space.
vec4 irradiance_remainder(vec3 direction) {
    return textureLod(irradiance_remainder_map,
                      octahedron_coordinates(direction, float(HARMONICS_REMAINDER_SIZE)), 0.0);
}

// For a mean normal of at most unit length, in the environment's space. Of normals that are
// distributed about a mean the remainder fades as harmonics of degree 4, the lowest of those that
// are missing, do: as exp(-l (l + 1) / (2 kappa)), of which the resultant is the one of degree 1.
vec3 irradiance_of_mean(vec3 mean_normal) {
    float square = min(dot(mean_normal, mean_normal), 1.0), fourth = square * square;
    vec3 direction = square > 1e-12 ? mean_normal : vec3(0.0, 0.0, 1.0);
    return max(harmonic_irradiance_of_mean_normal(irradiance.coefficients, mean_normal) +
                   square * fourth * fourth * irradiance_remainder(direction).rgb,
               vec3(0.0));
}

// Irradiance over pi, for a mean normal of at most unit length.
vec3 mean_irradiance(surface_point surface, vec3 mean_normal) {
    vec3 normal = to_environment(surface, mean_normal);
    if (ENVIRONMENT_METHOD == ENVIRONMENT_MIP)
        return environment.intensity * length(mean_normal) *
               textureLod(environment_cube, normal, 16.0).rgb;
    return (environment.intensity * INVERSE_PI) * irradiance_of_mean(normal);
}

// Of that, what comes from below the surface, of what the harmonics know: from a cube's last level
// as if it came evenly.
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

// ---------------------------------------------------------------------------------------------
// The same for Lambert's law, from the environment itself

// What a normal that leans away from `up` gathers of light from below, and what it loses of light
// from above, is together
//   E(n) - integral of <n, w> over <up, w> > 0,
// and linear in n: of normals that vary, their mean counts. The integral is the derivative of the
// irradiance at `up` (harmonic_light_along); that of the remainder is a difference on its map.

// Radiance from a lune of the sphere, weighed by the squared cosine along it: three points 45
// degrees apart (Gauss, Chebyshev), each blurred by a lobe of concentration 16 or as large texels.
vec3 light_of_lune(vec3 middle, vec3 along) {
    vec3 first = middle + along, last = middle - along;
    if (ENVIRONMENT_METHOD == ENVIRONMENT_SAMPLED) {
        float level = solid_angle_level(environment_width(), 2.0 * PI / 16.0);
        return 2.0 * textureLod(environment_cube, middle, level).rgb +
               textureLod(environment_cube, first, level).rgb +
               textureLod(environment_cube, last, level).rgb;
    }
    // prefiltered_concentration
    float level = log2(float(textureSize(prefiltered_environment, 0).x) / 16.0);
    return 2.0 * textureLod(prefiltered_environment, middle, level).rgb +
           textureLod(prefiltered_environment, first, level).rgb +
           textureLod(prefiltered_environment, last, level).rgb;
}

// Of both, how much comes from below. Normals that lean to all sides see all of the horizon, for
// which the map has the share. One that leans to one side, by the angle t, sees the lune below that
// side's horizon and loses the one above the other's: both weigh light by the sine of its angle to
// their edge, whose mean is at t/3. `towards`: unit, across `up`, to where the mean leans.
vec3 share_from_below(vec3 mean_normal, vec3 up, vec3 towards, float share_all_around) {
    float height = dot(mean_normal, up), aside = dot(mean_normal, towards);
    float one_sided = clamp(aside * aside / max(1.0 - height * height, 1e-6), 0.0, 1.0);
    float angle = atan(aside, height) / 3.0;
    vec3 below = cos(angle) * towards - sin(angle) * up, along = cross(up, towards);
    vec3 seen = light_of_lune(below, along), both = seen + light_of_lune(-below, along);
    return mix(vec3(share_all_around),
               vec3(both.r > 0.0 ? seen.r / both.r : 0.5, both.g > 0.0 ? seen.g / both.g : 0.5,
                    both.b > 0.0 ? seen.b / both.b : 0.5),
               one_sided);
}

// Of `all`, the irradiance over pi of normals with this mean, which is in the environment's space
// as `up` is.
vec3 lambert_from_below(vec3 all, vec3 mean_normal, vec3 up) {
    const float STEP = 0.1; // radians, about a texel of the map
    vec3 aside = mean_normal - dot(mean_normal, up) * up;
    float length_aside = length(aside);
    vec3 towards = length_aside > 1e-4 ? aside / length_aside
                                       : perpendicular_towards(up, vec3(1.0, 0.0, 0.0));
    vec4 here = irradiance_remainder(up);
    vec3 growth = (irradiance_remainder(up + STEP * towards).rgb -
                   irradiance_remainder(up - STEP * towards).rgb) / (2.0 * STEP);
    vec3 along = harmonic_light_along(irradiance.coefficients, mean_normal, up) +
                 dot(mean_normal, up) * here.rgb + length_aside * growth;
    return max(all - environment.intensity * INVERSE_PI * along, vec3(0.0)) *
           share_from_below(mean_normal, up, towards, here.w);
}

// Of `all`, the irradiance over pi of normals with this mean, what comes from above the surface.
vec3 lambert_from_above(surface_point surface, vec3 all, vec3 mean_normal) {
    if (HORIZON == HORIZON_IGNORED || !has_map(MAP_NORMAL))
        return all;
    vec3 below = ENVIRONMENT_METHOD == ENVIRONMENT_MIP
                     ? irradiance_from_below(surface, mean_normal)
                     : lambert_from_below(all, to_environment(surface, mean_normal),
                                          to_environment(surface, vec3(0.0, 0.0, 1.0)));
    return max(all - below, vec3(0.0));
}

// The same of sums with weights; `normals`: of them, w: of the weights.
vec3 lambert_sum_from_above(surface_point surface, vec3 sum, vec4 normals) {
    float weight = max(normals.w, 1e-6);
    return weight * lambert_from_above(surface, sum / weight, normals.xyz / weight);
}

// Irradiance over pi, without what comes from below the surface.
vec3 lambert_irradiance(surface_point surface, vec3 mean_normal) {
    return lambert_from_above(surface, mean_irradiance(surface, mean_normal), mean_normal);
}

#endif
