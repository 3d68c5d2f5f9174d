#ifndef ENVIRONMENT_GLSL
#define ENVIRONMENT_GLSL

// The environment's maps, and the mean radiance of a lobe of directions by each method.

#include "environment/lobe_row.glsl"
#include "interface/environment/environment_light.h"
#include "lib/lobe/direction_lobe.glsl"
#include "lib/light/environment_level.glsl"
#include "shading/surface.glsl"

layout(constant_id = SPECIALISE_ENVIRONMENT_METHOD) const uint ENVIRONMENT_METHOD =
    ENVIRONMENT_PREFILTERED;
layout(constant_id = SPECIALISE_ENVIRONMENT_PROBES) const uint ENVIRONMENT_PROBES = 2;
layout(constant_id = SPECIALISE_ENVIRONMENT_GRID) const uint ENVIRONMENT_GRID = 5;
layout(constant_id = SPECIALISE_ENVIRONMENT_BLENDED) const bool ENVIRONMENT_BLENDED = false;
layout(constant_id = SPECIALISE_HORIZON) const uint HORIZON = HORIZON_CLIPPED;

// Levels hold means over texels. The same cube is bound three times: without interpolation, with
// it, and as an array of faces to read texels by index.
layout(LOBE_DESCRIPTOR(23)) uniform samplerCube environment_texels;
layout(LOBE_DESCRIPTOR(24)) uniform samplerCube environment_cube;
layout(LOBE_DESCRIPTOR(25)) uniform sampler2DArray environment_faces;
// Levels hold the environment filtered with broader and broader lobes.
layout(LOBE_DESCRIPTOR(26)) uniform samplerCube prefiltered_environment;
layout(LOBE_DESCRIPTOR(27)) uniform samplerCube prefiltered_environment_ggx;
// The same levels of lobes twice as concentrated.
layout(LOBE_DESCRIPTOR(31)) uniform samplerCube environment_between;
layout(LOBE_DESCRIPTOR(28), std140) uniform environment_block {
    environment_constants environment;
};

vec3 world_to_environment(vec3 direction) {
    return vec3(dot(environment.environment_from_world[0].xyz, direction),
                dot(environment.environment_from_world[1].xyz, direction),
                dot(environment.environment_from_world[2].xyz, direction));
}

// From the tangent frame.
vec3 to_environment(surface_point surface, vec3 direction) {
    return world_to_environment(surface.world_from_tangent * direction);
}

float environment_width() {
    return float(textureSize(environment_cube, 0).x);
}

// The mean over about `solid_angle` around a direction in the environment's space.
vec3 environment_mean(vec3 direction, float solid_angle) {
    float level = solid_angle_level(environment_width(), solid_angle);
    return environment.intensity * textureLod(environment_cube, direction, level).rgb;
}

// A lobe of half vectors: its shape; for a base lobe also the kind and parameter, for a Gaussian
// DISTRIBUTION_VMF.
struct half_vector_distribution {
    direction_lobe shape;
    uint kind;
};

// McGuire, Evangelakos, Wilcox, Donow, Mara, 2013, Plausible Blinn-Phong Reflection of Standard
// Cube MIP-Maps: one fetch at the level whose texels are as large as the lobe of half vectors.
vec3 mip_radiance(surface_point surface, half_vector_distribution lobe, vec3 axis) {
    float exponent = 1.0 / max(lobe_variance(lobe.shape), 1e-8) - 1.0;
    return textureLod(environment_cube, to_environment(surface, axis),
                      mip_level(environment_width(), exponent)).rgb;
}

// How much of a round lobe has the long tails of GGX. Microfacets that reflect broad lobes cut
// their tails off at the horizon: these are von Mises-Fisher's.
float share_of_tails(uint kind, float concentration) {
    if (kind != DISTRIBUTION_GGX)
        return 0.0;
    // From alpha = 0.17 to 0.1 of directions.
    float alpha = inversesqrt(2.0 * concentration);
    return MODEL == MODEL_MICROFACET ? 1.0 - smoothstep(0.1, 0.17, alpha) : 1.0;
}

// Where a round lobe is read.
struct prefiltered_lobe {
    float tails;              // share of the GGX cube
    float level;              // of the cubes' levels
    prefiltered_blend levels; // of those that have no tails
};

// The lobes without tails may be read from two cubes, the others only from one.
prefiltered_lobe levels_of_lobe(uint kind, float width, float concentration) {
    prefiltered_lobe lobe;
    lobe.tails = share_of_tails(kind, concentration);
    lobe.level = prefiltered_level(width, concentration);
    lobe.levels = ENVIRONMENT_BLENDED ? blend_of_lobe(width, concentration)
                                      : prefiltered_blend(lobe.level, 0.0, 1.0);
    return lobe;
}

float finest_concentration(uint kind, float width) {
    bool blended = ENVIRONMENT_BLENDED && kind != DISTRIBUTION_GGX;
    return prefiltered_concentration(width, 0.0) * (blended ? 2.0 : 1.0);
}

// Mean radiance over a round lobe.
vec3 prefiltered_radiance(vec3 direction, prefiltered_lobe lobe) {
    vec3 radiance = vec3(0.0);
    if (lobe.tails < 1.0) {
        radiance = textureLod(prefiltered_environment, direction, lobe.levels.level).rgb;
        if (ENVIRONMENT_BLENDED)
            radiance =
                mix(textureLod(environment_between, direction, lobe.levels.level_between).rgb,
                    radiance, lobe.levels.share);
    }
    if (lobe.tails > 0.0)
        radiance = mix(radiance, textureLod(prefiltered_environment_ggx, direction, lobe.level).rgb,
                       lobe.tails);
    return radiance;
}

// A lobe sharper than the finest level blends towards the unfiltered radiance: how far.
float unfiltered_share(uint kind, float width, float concentration) {
    return radiance_share(finest_concentration(kind, width), environment_width(), concentration);
}

// Mean radiance over a round lobe about a unit vector of the tangent frame.
vec3 round_radiance(surface_point surface, uint kind, vec3 axis, float concentration) {
    vec3 direction = to_environment(surface, axis);
    float width = float(textureSize(prefiltered_environment, 0).x);
    vec3 radiance = prefiltered_radiance(direction, levels_of_lobe(kind, width, concentration));
    float unfiltered = unfiltered_share(kind, width, concentration);
    if (unfiltered > 0.0)
        radiance = mix(radiance, textureLod(environment_cube, direction, 0.0).rgb, unfiltered);
    return radiance;
}

// An elongated lobe as a row of round ones.
vec3 probed_radiance(surface_point surface, uint kind, direction_lobe incoming) {
    direction_lobe lobe = principal_lobe(incoming);
    float major = dot(lobe.first, lobe.first);
    float minor = dot(lobe.second, lobe.second);
    lobe_row row = row_of_lobe(major, minor, float(ENVIRONMENT_PROBES));
    float width = float(textureSize(prefiltered_environment, 0).x);
    float concentration = 1.0 / max(row.variance, 1e-8);
    prefiltered_lobe levels = levels_of_lobe(kind, width, concentration);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint i = 0u; i < uint(row.count); ++i) {
        vec2 place = place_in_row(row, i);
        vec3 direction = lobe.axis + place.x * row.reach * lobe.first;
        sum += place.y * prefiltered_radiance(to_environment(surface, direction), levels);
        weights += place.y;
    }
    float unfiltered = row.count > 1.0 ? 0.0 : unfiltered_share(kind, width, concentration);
    vec3 radiance = textureLod(environment_cube, to_environment(surface, lobe.axis), 0.0).rgb;
    return mix(sum / weights, radiance, unfiltered);
}

// Mean radiance over the lobe of incoming directions that corresponds to a lobe of half vectors.
vec3 lobe_radiance(surface_point surface, half_vector_distribution lobe, direction_lobe incoming) {
    vec3 mean = ENVIRONMENT_METHOD == ENVIRONMENT_MIP
                    ? mip_radiance(surface, lobe, incoming.axis)
                    : probed_radiance(surface, lobe.kind, incoming);
    return environment.intensity * mean;
}

#endif
